"""`comity profile ask`: the one question to a person, and how their answer is to count."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

import typer

from comity.commands.options import (
    AsJson,
    At,
    JudgingRulebookName,
    KeptName,
    Set,
    day,
    pairs,
    print_json,
    require_terminal,
)

if TYPE_CHECKING:
    from comity.adaptation.asking import CountsAs, Question
    from comity_fis import Rulebook


def ask(
    name: KeptName,
    *,
    answer: Annotated[
        str | None, typer.Option(metavar="METRES", help="The answer, for example 0.9 or '90 cm'.")
    ] = None,
    counts_as: Annotated[
        Literal["setting", "observation"] | None,
        typer.Option(
            "--counts-as",
            help="A setting goes before everything but safety; an observation is weighed with what the "
            "person shows. The choice is theirs; with --answer alone it is a setting.",
        ),
    ] = None,
    set_: Set = [],  # noqa: B006  (Typer copies it)
    at: At = None,
    rulebook: JudgingRulebookName = None,
    as_json: AsJson = False,
) -> None:
    """Ask a person the one question that tells more than where they are from: how near is near enough.

    The answer counts as their wish, or as one more observation in its situation (--set posture=seated;
    without it the posture that they declared, or standing). `unknown` takes back what was answered before.

    For example: comity profile ask amal --answer 0.9 --counts-as observation
    """
    from datetime import date

    from comity.adaptation.asking import ask_in
    from comity.adaptation.editing import books
    from comity.adaptation.observers_words import situation_told
    from comity.report.people.asking import ask_answer, ask_text
    from comity.report.text import show
    from comity_fis import Where

    judges = books(rulebook)
    question = ask_in(
        name,
        judges,
        day(at) or date.today(),
        situation_told(pairs(set_, "--set", "posture=seated"), judges.first, Where("--set")),
    )
    said, counts_as = _heard(name, answer, counts_as, judges.first)
    answer_m = _keep(question, said, counts_as) if counts_as else None
    value = question.met_at() if counts_as else None
    if as_json:
        print_json(ask_answer(question, answer_m, counts_as, value))
    else:
        show(*ask_text(question, answer_m, counts_as, value))


def _heard(
    name: str, answer: str | None, counts_as: CountsAs | None, rulebook: Rulebook
) -> tuple[str, CountsAs | None]:
    """What the person says, and as what it is to count; None where they leave the question open."""
    said = answer if answer is not None else _answer(name, rulebook)
    if not said.strip():
        return "", None
    return said, counts_as or ("setting" if answer is not None else _choice())


def _answer(name: str, rulebook: Rulebook) -> str:
    """What a person at the terminal types."""
    from comity_fis import NumericParameter

    require_terminal("profile ask", "--answer METRES")
    parameter = rulebook.parameters.get("conversational_distance")
    range_ = f" ({parameter.ask})" if isinstance(parameter, NumericParameter) else ""
    question = f"{name}, how near may the robot come to you, in metres?{range_} Enter leaves it open"
    return str(typer.prompt(question, default="", show_default=False))


def _choice() -> CountsAs:
    """A wish or an observation, as a person at the terminal types it."""
    import click

    chosen: CountsAs = typer.prompt(
        "Is that a wish, which the robot always keeps to (setting),\n"
        "or should it be weighed with what you show from visit to visit (observation)?",
        type=click.Choice(["setting", "observation"]),
        default="setting",
    )
    return chosen


def _keep(question: Question, said: str, counts_as: CountsAs) -> float | None:
    return question.setting(said) if counts_as == "setting" else question.observation(said)
