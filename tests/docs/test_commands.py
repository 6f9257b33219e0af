"""Every command that the documents name exists, with its options; so does what it names.

`test_documents.py` runs what stands in console blocks; sentences and tables name commands, too.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from typer.main import get_command

from comity.cli import app
from comity.system.library import shipped
from comity_fis import shipped_rulebooks
from comity_sim2d import shipped_maps

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("*/README.md")]
)
SPAN = re.compile(r"`comity(?P<within> [^`]*)?`|^\$ comity(?P<block> .*)?$", re.MULTILINE)
PUNCTUATION = re.compile(r"[\[\]]|\.\.\.|…")
"""Of a form such as `comity run [SCENARIO] [--as PERSON=PROFILE ...]`."""
MAKING = re.compile(r"^```\w+ (\S+)$|--out (\S+)|profile set (\w+)", re.MULTILINE)
"""How a page makes a file, a folder or a stored person."""
SHIPPED = {*shipped("scenario"), *shipped("profile"), *shipped_rulebooks(), *shipped_maps()}
READ = frozenset(
    [
        "scenario",
        "profile",
        "rulebook",
        "place",
        "source",
        "name",
        "domain",
        "problem",
        "bind",
        "tuples",
        "file",
        "run",
        "other",
    ]
)
"""Parameters that name something which must be there."""
REDIRECTION = {"|", ">", "<", "&&", "||", ";", "2>"}


@dataclass(frozen=True)
class Named:
    """A command as a page names it."""

    page: Path
    line: int
    text: str
    is_run: bool
    """It stands in a console block."""

    @property
    def words(self) -> list[str]:
        words = shlex.split(PUNCTUATION.sub(" ", self.text.replace("\\|", "\\\\|")))
        end = next((i for i, word in enumerate(words) if word in REDIRECTION), len(words))
        return words[:end]

    def __str__(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}: comity {self.text}"


def named() -> Iterator[Named]:
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for found in SPAN.finditer(text):
            words = " ".join((found["within"] or found["block"] or "").split())
            yield Named(page, text.count("\n", 0, found.start()) + 1, words, found[0].startswith("$"))


COMMANDS = [*named()]


def read(words: Sequence[str]) -> dict[str, Any]:
    """What the command line reads in some words, by parameter, before it checks types and what is missing."""
    command: Any = get_command(app)
    words = list(words)
    while hasattr(command, "commands") and words and not words[0].startswith("-"):
        assert words[0] in command.commands, f"there is no command {words[0]}"
        command = command.commands[words.pop(0)]
    if words and words[-1] in (options := _with_values(command)):  # `comity trace --why`: the option is meant
        words += ["VALUE"] * options[words[-1]]
    found, rest, _ = command.make_parser(command.context_class(command)).parse_args(args=words)
    assert rest == []
    return {name: value for name, value in found.items() if value is not None}


def _with_values(command: Any) -> dict[str, int]:
    """How many words each option takes."""
    taking = (one for one in command.params if one.param_type_name == "option" and not one.is_flag)
    return {option: one.nargs for one in taking for option in one.opts}


@pytest.mark.parametrize("one", COMMANDS, ids=str)
def test_a_command_in_the_documents_is_one_of_the_command_line(one):
    read(one.words)


@pytest.mark.parametrize("one", [one for one in COMMANDS if not one.is_run], ids=str)
def test_what_a_command_within_a_sentence_names_ships_or_is_made_on_the_page(one):
    """A name in capitals stands for any."""
    names = [name for key, name in read(one.words).items() if key in READ and isinstance(name, str)]
    made = {name for names in MAKING.findall(one.page.read_text(encoding="utf-8")) for name in names}
    runs = {f"runs/{scenario}-1" for scenario in shipped("scenario")}
    assert {name for name in names if not name.partition(".")[0].isupper()} <= SHIPPED | made | runs


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_what_make_is_asked_for_in_the_documents_it_can_make(page):
    targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    assert set(re.findall(r"`make ([a-z]+)", page.read_text(encoding="utf-8"))) <= {*targets}
