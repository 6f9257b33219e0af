"""The page of a study: one HTML file with embedded pictures and no network requests."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from importlib.resources import files
from typing import TYPE_CHECKING

from comity.report.drawing import COLOURS, FAINT, GREY, INK
from comity.report.text import words
from comity.study.report.outcomes import SERVED, label_of
from comity.study.report.resampling import RESAMPLES
from comity.study.report.serving import SAME
from comity.study.report.telling import (
    HEAD,
    difference_cells,
    few_of,
    few_text,
    interval_text,
    number_text,
    value_text,
    worse_text,
)

if TYPE_CHECKING:
    from pathlib import Path

    from comity.answers.study_report import (
        ShortfallAnswer,
        StudyCompareAnswer,
        StudyLevelAnswer,
        StudyReportAnswer,
        UnusualVisitAnswer,
    )
    from comity.study.results import Study

MARK = b'<meta name="generator" content="Comity study report">'
"""Marker near the start of every page: such a file may be replaced by another page."""
MOST_LISTED = 50
"""Maximum number of failures, and of outliers, on a page; `--json` has all."""

THEMED = {
    colour.lower(): f"var(--{name})"
    for colour, name in (
        (INK, "ink"),
        (GREY, "soft"),
        (FAINT, "line"),
        *((one, f"c{i}") for i, one in enumerate(COLOURS)),
    )
}
"""CSS variables of the page by a figure's colours; the page has a light and a dark theme."""


def page_of_study(answer: StudyReportAnswer, study: Study, figures: Mapping[str, Path]) -> str:
    """The HTML of a study; the same study gives the same bytes.

    Args:
        answer: The results.
        study: The study, for the data dictionary.
        figures: SVG files by name.
    """
    body = "\n".join(
        (
            *_head(answer),
            *_served(answer),
            *_outcomes(answer, figures),
            *_comparisons(answer, figures),
            *_unusual("failures", "Failures", answer.first_failures, _FAILED),
            *_unusual("outliers", "Outliers", answer.farthest_outliers, _FAR),
            *_dictionary(study),
        )
    )
    shell = files("comity.study.report")
    page = shell.joinpath("page.html").read_text(encoding="utf-8")
    style = shell.joinpath("page.css").read_text(encoding="utf-8")
    page = page.replace("/* STYLE */", style).replace("/* TITLE */", escape(f"Study {answer.study}"))
    return page.replace("/* STATEMENT */", escape(answer.statement)).replace("/* BODY */", body)


_FAILED = "Visits without a greeting that the person did not decline, and episodes that raised."
_FAR = (
    "Visits unlike the other seeds of the same individual: farther from their median than the outer fence, "
    "three interquartile ranges beyond the quartiles of all such differences in the same room under the same "
    "condition. A range counts as at least half the standard deviation over all visits. Where no visit "
    "was repeated, the fence is around the values. The farthest first; visits with the same trace stand once."
)


def _head(answer: StudyReportAnswer) -> Iterator[str]:
    counts = (
        ("visits", answer.visits),
        ("individuals", answer.individuals),
        ("rooms", answer.rooms),
        ("conditions", answer.conditions),
        ("seeds", answer.seeds),
        ("failures", answer.failures),
        ("outliers", answer.outliers),
    )
    cells = "".join(f"<div><dt>{name}</dt><dd>{count}</dd></div>" for name, count in counts)
    yield f'<dl class="counts">{cells}</dl>'
    yield '<section id="reading"><h2>How to read it</h2><ul>'
    yield (
        "<li>A mean is taken over individuals and rooms, each counted once, however many seeds it has. "
        f"<b>Intervals</b> (95 %) resample individuals, rooms and seeds {RESAMPLES} times, each on its own, "
        "never episodes: all individuals share the noise of a seed. More of each narrows them.</li>"
    )
    yield (
        "<li>The <b>Monte Carlo error</b> is the standard error that the choice of seeds leaves, a part of "
        "the interval: with more seeds it goes to 0.</li>"
    )
    yield (
        "<li>There are no p-values: with enough simulated episodes every difference would be significant. "
        "Look at its size, in its unit.</li>"
    )
    if few := few_of(one.estimate for one in answer.levels if one.estimate):
        yield f"<li><b>{few_text(few)}</b></li>"
    if answer.rooms == 1:
        yield "<li><b>One room</b>: nothing here says how results vary from room to room.</li>"
    if answer.left_out:
        yield (
            f"<li>{answer.left_out} visits to other people of the scenarios are in the table and not "
            "compared: they are not individuals of the population.</li>"
        )
    yield "</ul></section>"


def _served(answer: StudyReportAnswer) -> Iterator[str]:
    yield '<section id="served"><h2>Who is served worse, and by which parameter</h2>'
    if not answer.shortfalls:
        yield "<p>The population has no groups to compare.</p></section>"
        return
    apart = [one for one in answer.served_worse if one.told_apart]
    if apart:
        yield "<p>Groups whose intervals lie apart, by the assumptions of this study:</p><ul>"
        yield from (f"<li>{escape(worse_text(one))}</li>" for one in apart)
        yield "</ul>"
    else:
        yield "<p>No two groups have intervals that lie apart, by any parameter.</p>"
    yield "<p class='note'>0 is best; the worst group of each rulebook stands first.</p>"
    missed = {one.parameter for one in answer.shortfalls if abs(one.missed.mean) > SAME}
    parameters = dict.fromkeys(one.parameter for one in answer.shortfalls)
    if idle := [escape(words(one)) for one in parameters if one not in missed]:
        yield f"<p>No group misses anything by: {', '.join(idle)}.</p>"
    for parameter in parameters:
        some = [one for one in answer.shortfalls if one.parameter == parameter and parameter in missed]
        if not some:
            continue
        yield f"<h3>{escape(words(parameter))}</h3><p class='note'>{escape(answer.meanings[parameter])}</p>"
        yield _table(
            ("rulebook", "group", "missed", "95 % interval", "Monte Carlo error"), map(_missed, some)
        )
    if answer.individuals_served_worst:
        yield "<h3>individuals farthest outside their comfort</h3>"
        rows = (
            (one.individual, one.group, one.rulebook, f"{number_text(one.outside_comfort_m)} m")
            for one in answer.individuals_served_worst
        )
        yield _table(("individual", "group", "rulebook", "outside comfort"), rows)
    yield "</section>"


def _missed(one: ShortfallAnswer) -> tuple[str, ...]:
    error = one.missed.monte_carlo_error
    return (
        one.rulebook,
        one.group,
        value_text(one.missed.mean, one.unit),
        interval_text(one.missed),
        number_text(error),
    )


def _outcomes(answer: StudyReportAnswer, figures: Mapping[str, Path]) -> Iterator[str]:
    yield '<section id="outcomes"><h2>Outcomes by factor</h2>'
    yield (
        "<p class='note'>A ring is an individual in a room, the mean of its episodes at that level. The "
        "diamond is the mean, the bar its interval.</p>"
    )
    by_outcome: dict[str, list[StudyLevelAnswer]] = {}
    for one in answer.levels:
        by_outcome.setdefault(one.outcome, []).append(one)
    plain = []
    for name, levels in by_outcome.items():
        label, means = escape(label_of(name, levels[0].unit)), escape(answer.meanings[name])
        if name in figures or name == SERVED:
            yield f'<div class="outcome" id="{escape(name)}"><h3>{label}</h3><p class="note">{means}</p>'
            if name in figures:
                yield from _figure(name, figures[name], f"{label_of(name, levels[0].unit)} by factor")
            yield f"<details><summary>Numbers</summary>{_levels(levels)}</details></div>"
        else:
            plain.append(
                f'<details><summary>{label}</summary><p class="note">{means}</p>{_levels(levels)}</details>'
            )
    if plain:
        yield "<h3>Other outcomes</h3><p class='note'><code>--outcome COLUMN</code> draws them.</p>"
        yield from plain
    yield "</section>"


def _levels(levels: Iterable[StudyLevelAnswer]) -> str:
    head = (
        "factor",
        "level",
        "mean",
        "95 % interval",
        "Monte Carlo error",
        "episodes",
        "individuals",
        "rooms",
        "seeds",
    )
    return _table(head, map(_level, levels))


def _level(one: StudyLevelAnswer) -> tuple[str, ...]:
    found = one.estimate
    if found is None:
        return (words(one.factor), one.level, "-", "-", "-", "0", "0", "0", "0")
    return (
        words(one.factor),
        one.level,
        value_text(found.mean, one.unit),
        interval_text(found),
        number_text(found.monte_carlo_error),
        *map(str, (found.episodes, found.individuals, found.rooms, found.seeds)),
    )


def _comparisons(answer: StudyReportAnswer, figures: Mapping[str, Path]) -> Iterator[str]:
    yield '<section id="differences"><h2>Differences within the same individual</h2>'
    if not answer.comparisons:
        yield "<p>No factor has levels that the same individual, room and seed meet.</p>"
    else:
        yield (
            "<p class='note'>Second minus first, in the unit of the outcome, over visits that differ in the "
            "factor alone: same individual, room, seed, and other factors. In the first figure each sign "
            "is an individual: above the line the second is larger. In the next, a dot is the mean of a "
            "group, the diamond that of all, and the bar its interval.</p>"
        )
    for i, one in enumerate(answer.comparisons, start=1):
        first, second = escape(one.first), escape(one.second)
        yield f"<div class='outcome'><h3>{escape(words(one.factor))}: {first} and {second} side by side</h3>"
        name = f"side_by_side_{i}"
        if name in figures:
            yield from _figure(name, figures[name], f"{words(one.factor)}: {one.first} and {one.second}")
        if (name := f"by_group_{i}") in figures:
            yield from _figure(name, figures[name], f"{one.second} minus {one.first}, by group")
        yield f"</div>{_differences(one)}"
    yield "</section>"


def _differences(one: StudyCompareAnswer) -> str:
    head = (*HEAD[:2], one.first, one.second, *HEAD[4:])
    return _table(head, map(difference_cells, one.differences))


def _unusual(name: str, title: str, found: Sequence[UnusualVisitAnswer], about: str) -> Iterator[str]:
    yield f'<section id="{name}"><h2>{title}</h2><p class="note">{about}</p>'
    if not found:
        yield "<p>None.</p></section>"
        return
    if len(found) > MOST_LISTED:
        yield (
            f"<p>{MOST_LISTED} of {len(found)}; <code>comity study report DIR --json</code> lists all of "
            "them.</p>"
        )
    yield (
        "<p class='note'>The command plays the episode again and writes its page; "
        "<code>comity study report DIR --play N</code> does so for the first N.</p>"
    )
    head = ("row", "what", "why", "scenario", "condition", "individual", "seed", "visits alike", "episode")
    rows = (
        (
            *map(escape, (str(one.row), words(one.what), one.why, one.scenario, one.condition)),
            *map(escape, (one.individual, one.seed, str(one.alike))),
            _episode(one),
        )
        for one in found[:MOST_LISTED]
    )
    yield _markup_table(head, rows)
    yield "</section>"


def _episode(one: UnusualVisitAnswer) -> str:
    command = f"<code>comity study show DIR --row {one.row}</code>"
    return command if one.page is None else f'<a href="{escape(one.page)}">its page</a> {command}'


def _dictionary(study: Study) -> Iterator[str]:
    yield '<section id="dictionary"><h2>The columns of the table</h2><details><summary>All columns</summary>'
    rows = ((name, one["unit"], one["definition"], one["source"]) for name, one in study.columns.items())
    yield _table(("column", "unit", "definition", "source"), rows)
    last = study.rows[0] if study.rows else {}
    told = ", ".join(f"{name} {last[name]}" for name in ("version", "code", "fingerprint") if last.get(name))
    yield f"</details><p class='note'>{escape(f'Comity {told}')}</p></section>"


def _figure(name: str, path: Path, says: str) -> Iterator[str]:
    """An SVG in the page, in the page's colours, with links to its files."""
    svg = themed(path.read_text(encoding="utf-8"), name)
    svg = svg.replace("<svg ", f'<svg role="img" aria-label="{escape(says)}" ', 1)
    yield f'<figure><div class="picture">{svg}</div>'
    links = " ".join(f'<a href="figures/{name}.{form}">{form.upper()}</a>' for form in ("svg", "pdf"))
    yield f"<figcaption>{escape(says)} <span class='files'>{links}</span></figcaption></figure>"


def themed(svg: str, name: str) -> str:
    """The element of an SVG file with unique ids and the colours of the page.

    Args:
        svg: Content of the file.
        name: Name of the figure, which makes ids unique in the page.
    """
    svg = svg[svg.index("<svg ") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r'(\bid="|="#|url\(#)', rf"\g<1>{name}-", svg)
    colours = re.compile("|".join(map(re.escape, THEMED)), re.IGNORECASE)
    svg = colours.sub(lambda found: THEMED[found[0].lower()], svg)
    return re.sub(r' (width|height)="[\d.]+pt"', "", svg, count=2)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    return _markup_table(head, (tuple(map(escape, row)) for row in rows))


def _markup_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    top = "".join(f'<th scope="col">{escape(one)}</th>' for one in head)
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    table = f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>"
    return f'<div class="wide" tabindex="0">{table}</div>'


_NUMBER = re.compile(r"[-+]?[\d.]+(e[-+]\d+)?( [a-z/^0-9]+| to [-+]?[\d.]+(e[-+]\d+)?)?|-")


def _cell(markup: str) -> str:
    kind = ' class="number"' if _NUMBER.fullmatch(markup) else ""
    return f"<td{kind}>{markup}</td>"
