"""A person's parameters over the years, as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.profile import LifeAnswer, YearAnswer, YearValueAnswer
from comity.report.text import number, table, words, words_of
from comity.report.values.inference import inputs_answer

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.console import RenderableType

    from comity.adaptation.life import Year
    from comity_fis import ParameterValue


def life_answer(name: str, years: Sequence[Year], picture: str | None) -> LifeAnswer:
    """The answer of `comity profile show --years --json`."""
    return LifeAnswer(
        name=name,
        rulebook=years[0].inference.rulebook,
        years=tuple(
            YearAnswer(
                at=year.day,
                changed=tuple(year.changed),
                inputs=inputs_answer(year.inference.inputs),
                parameters={
                    value.name: YearValueAnswer(
                        value=value.value, unit=value.unit, spread=value.spread, origin=value.origin
                    )
                    for value in year.inference.values()
                },
            )
            for year in years
        ),
        picture=picture,
    )


def life_text(name: str, years: Sequence[Year]) -> Iterator[RenderableType]:
    """A row for each year; parameters that never change are named below."""
    varying = changing(years)
    yield (
        f"{name} from {years[0].day.year} to {years[-1].day.year}, at the end of each year, "
        f"as the rulebook {years[0].inference.rulebook} has it"
    )
    yield table(
        [
            (
                str(year.day.year),
                *(_bare(year.inference[name]) for name in varying),
                ", ".join(words(change) for change in year.changed),
            )
            for year in years
        ],
        head=("year", *(_short(years[0].inference[name], varying) for name in varying), "what changed"),
    )
    same = [name for name in years[0].inference.parameters if name not in varying]
    if same:
        yield f"  The same all the time: {words_of(same)}."
    for note in dict.fromkeys(note for year in years for note in year.inference.notes):
        yield f"  Note: {note}"


def _bare(value: ParameterValue) -> str:
    """The value without its unit, which is in the heading."""
    return number(value.value, value.unit).removesuffix(f" {value.unit}")


def _short(value: ParameterValue, names: Sequence[str]) -> str:
    """Short heading such as `distance [m]`: the last word of a name if unambiguous, to fit on a page."""
    last = value.name.rsplit("_", 1)[-1]
    unique = sum(name.rsplit("_", 1)[-1] == last for name in names) == 1
    name = last if unique else words(value.name)
    return f"{name} [{value.unit}]" if value.unit else name


def changing(years: Sequence[Year]) -> list[str]:
    """Parameters that change over the years."""
    return [
        name
        for name in years[0].inference.parameters
        if len({year.inference[name].value for year in years}) > 1
    ]
