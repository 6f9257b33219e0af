"""The page docs/reference/wordings.md, made from the wordings: `python tests/wordings_page.py` writes it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from comity_executor import Language
from comity_executor.speech.phrasebook import SHIPPED

PAGE = Path(__file__).parents[1] / "docs" / "reference" / "wordings.md"
HEAD = """\
# The wordings that ship

<!-- Made from the wordings by tests/wordings_page.py; a test holds the two together. -->

What the robot can say, in {languages} languages, each with its facts. Of {count} wordings {reviewed} were
reviewed by somebody who speaks the language. A real robot says reviewed ones and those of the register
`plain`: [how to review and add one](../how-to/add-and-review-wordings.md).
"""
NAMES = {"ar": "Arabic", "de": "German", "en": "English", "ja": "Japanese", "sv": "Swedish"}


def page() -> str:
    """The whole page."""
    languages = [SHIPPED[code] for code in SHIPPED]
    every = [one for language in languages for one in language.wordings]
    reviewed = sum(one.is_reviewed for one in every) or "none"
    head = HEAD.format(languages=len(languages), count=len(every), reviewed=reviewed)
    return "\n".join([head, *(line for language in languages for line in _section(language))])


def _section(language: Language) -> Iterator[str]:
    script = language.wordings[0].script
    yield f"## {NAMES[language.tag]}\n"
    yield f"`{language.tag}`, in rulebooks `{language.code}`; script `{script}`."
    forms = {f"{form.text} = {form.latin}" for form in language.names.values()}
    if forms:
        yield f"Names of which no form was stated: {', '.join(sorted(forms))}."
    yield ""
    latin = script != "Latn"
    columns = ["to", "register", "occasion", "text", *(["in Latin letters"] if latin else []), "reviewed by"]
    yield _row(columns)
    yield _row(["---"] * len(columns))
    for one in language.wordings:
        review = f"{one.reviewed_by}, {one.reviewed_on}" if one.is_reviewed else "nobody"
        occasion = "first meeting" if one.occasion else "any"
        yield _row(
            [f"`{one.use}`", one.register, occasion, one.text, *([one.latin] if one.latin else []), review]
        )
    yield ""


def _row(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
