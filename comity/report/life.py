"""One life over the years, as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers import LifeAnswer
from comity.report.text import number, table, words, words_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.console import RenderableType

    from comity.life import Year


def life_answer(name: str, years: Sequence[Year], picture: str | None) -> LifeAnswer:
    """The answer of `comity profile show --years --json`."""
    return LifeAnswer.model_validate(
        {
            "name": name,
            "rulebook": years[0].inference.rulebook,
            "years": [
                {
                    "at": year.day,
                    "changed": year.changed,
                    "inputs": year.inference.as_json()["inputs"],
                    "parameters": {
                        value.name: {
                            "value": value.value,
                            "unit": value.unit,
                            "spread": value.spread,
                            "origin": value.origin,
                        }
                        for value in year.inference.parameters.values()
                    },
                }
                for year in years
            ],
            "picture": picture,
        }
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
                *(number(year.inference[name].value, year.inference[name].unit) for name in varying),
                ", ".join(words(change) for change in year.changed),
            )
            for year in years
        ],
        head=("year", *map(words, varying), "what changed"),
    )
    same = [name for name in years[0].inference.parameters if name not in varying]
    if same:
        yield f"  The same all the time: {words_of(same)}."
    for note in dict.fromkeys(note for year in years for note in year.inference.notes):
        yield f"  Note: {note}"


def changing(years: Sequence[Year]) -> list[str]:
    """The parameters that are not the same in all years."""
    return [
        name
        for name in years[0].inference.parameters
        if len({year.inference[name].value for year in years}) > 1
    ]
