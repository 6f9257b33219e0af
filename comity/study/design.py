"""Combination of factors into conditions."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, product
from typing import TYPE_CHECKING, Any

from comity.study.study_file import StudyFile, ValueRange
from comity_fis import InputError, unknown_word
from comity_fis.listing import listed

if TYPE_CHECKING:
    from comity_fis.errors import Location
    from comity_fis.validation.yaml_file import YamlFile

MOST = 100_000
"""Maximum number of conditions of a study."""

Values = dict[str, Any]
"""Values by the path of their key in the scenario."""


@dataclass(frozen=True, slots=True)
class StudyCondition:
    """One combination of the factors' values."""

    number: int
    """Number of the condition, from 1, in the order of the design."""
    values: Mapping[str, Any]
    places: Mapping[str, tuple[str | int, ...]]
    """By path, the place of the value in the study's file."""


def conditions_of(file: YamlFile, written: StudyFile) -> tuple[StudyCondition, ...]:
    """All conditions of a study; a single one without values if there are no factors.

    Raises:
        InputError: with the line, for factors that the design cannot combine.
    """
    _require_keys(file, written)
    if written.design == "list":
        refuse_repeated(file, ("conditions",), written.conditions, "condition")
        return tuple(
            StudyCondition(i + 1, values, {path: ("conditions", i, path) for path in values})
            for i, values in enumerate(written.conditions)
        )
    lists = {path: levels for path, levels in written.factors.items() if not isinstance(levels, ValueRange)}
    ranges = {path: levels for path, levels in written.factors.items() if isinstance(levels, ValueRange)}
    _require_ranges(file, written, ranges)
    blocks: list[Sequence[Values]] = [_sampled(written, ranges)] if ranges else []
    together = (tuple(lists),) if written.design == "in step" and lists else written.in_step
    blocks += [_in_step(file, group, lists) for group in _groups(file, together, lists)]
    count = 1
    for block in blocks:
        count *= len(block)
    if count > MOST:
        raise InputError(
            expected=f"at most {MOST} conditions",
            got=str(count),
            remedy="Leave values out, or fill ranges by `design: latin hypercube`.",
            where=file.where(("factors",)),
        )
    order = tuple(written.factors)
    return tuple(
        StudyCondition(number, values, {path: _place(path, values[path], lists) for path in values})
        for number, values in enumerate(_combined(blocks, order), 1)
    )


def _place(path: str, value: Any, lists: Mapping[str, Sequence[Any]]) -> tuple[str | int, ...]:
    levels = lists.get(path)
    return ("factors", path) if levels is None else ("factors", path, list(levels).index(value))


def _combined(blocks: Sequence[Sequence[Values]], order: Sequence[str]) -> Iterator[Values]:
    """The Cartesian product of blocks; the last block changes fastest."""
    for choice in product(*blocks):
        merged = dict(chain.from_iterable(values.items() for values in choice))
        yield {path: merged[path] for path in order}


def _require_keys(file: YamlFile, written: StudyFile) -> None:
    """Check that the file has the keys of its design, and no others."""
    design = written.design
    needed = {"list": ("conditions",), "latin hypercube": ("factors", "samples"), "in step": ("factors",)}
    foreign = {
        "conditions": ("list",),
        "samples": ("latin hypercube",),
        "in_step": ("full", "latin hypercube"),
    }
    for key in needed.get(design, ()):
        if not getattr(written, key):
            raise InputError(
                expected=f"`{key}` beside `design: {design}`",
                got="nothing",
                remedy=f"Add `{key}: ...`, or choose another design.",
                where=file.where(("design",)),
            )
    for key, designs in foreign.items():
        if getattr(written, key) and design not in designs:
            raise InputError(
                expected=f"`design: {listed(designs, 'or')}` beside `{key}`",
                got=f"`design: {design}`",
                remedy="Change the design, or remove the key.",
                where=file.where((key,)),
            )
    if design == "list" and written.factors:
        raise InputError(
            expected="either `factors` or listed `conditions`",
            got="both",
            remedy="Write the values into the conditions.",
            where=file.where(("factors",)),
        )


def _require_ranges(file: YamlFile, written: StudyFile, ranges: Mapping[str, ValueRange]) -> None:
    if ranges and written.design != "latin hypercube":
        path = next(iter(ranges))
        raise InputError(
            expected=f"a list of values for {path}",
            got=f"a range beside `design: {written.design}`",
            remedy="Write for example `[0, 0.02]`, or choose `design: latin hypercube`.",
            where=file.where(("factors", path)),
        )
    if not ranges and written.design == "latin hypercube":
        raise InputError(
            expected="a factor with a range beside `design: latin hypercube`",
            got="lists alone",
            remedy="Write for example `robot.sensor.noise_m: {from: 0, to: 0.05}`.",
            where=file.where(("design",)),
        )


def _groups(
    file: YamlFile, together: Sequence[Sequence[str]], lists: Mapping[str, Sequence[Any]]
) -> Iterator[Sequence[str]]:
    """Groups of factors that change together, and each other factor alone, in the order of the factors."""
    of: dict[str, Sequence[str]] = {}
    for i, group in enumerate(together):
        for path in group:
            where = file.where(("in_step", i))
            if path not in lists:
                raise unknown_word("a factor with a list of values", path, lists, where=where)
            if path in of:
                raise InputError(
                    expected="each factor in one group",
                    got=f"{path!r} again",
                    remedy="Keep it in one of them.",
                    where=where,
                )
            of[path] = group
    seen: set[str] = set()
    for path in lists:
        if path not in seen:
            group = of.get(path, (path,))
            seen.update(group)
            yield group


def _in_step(file: YamlFile, group: Sequence[str], lists: Mapping[str, Sequence[Any]]) -> Sequence[Values]:
    first, *others = group
    for path in others:
        if len(lists[path]) != len(lists[first]):
            raise InputError(
                expected=f"as many values of {path} as of {first}: {len(lists[first])}",
                got=str(len(lists[path])),
                remedy="Factors in step change together: write one value for each of the other's.",
                where=file.where(("factors", path)),
            )
    found = [{path: lists[path][i] for path in group} for i in range(len(lists[first]))]
    refuse_repeated(file, ("factors", first), found, f"value of {listed(group)}")
    return found


def refuse_repeated(file: YamlFile, place: Location, items: Sequence[Any], what: str) -> None:
    """Refuse a list with a duplicate item.

    Args:
        file: The study's file.
        place: Place of the list.
        items: Its items.
        what: What an item is, for the message.

    Raises:
        InputError: with the line of the second one.
    """
    seen: set[str] = set()
    for i, item in enumerate(items):
        if (text := json.dumps(item, sort_keys=True, default=str)) in seen:
            raise InputError(
                expected=f"each {what} once",
                got=f"{_told(item)} again",
                remedy="Remove it; more seeds repeat an episode.",
                where=file.where((*place, i)),
            )
        seen.add(text)


def _told(item: Any) -> str:
    return ", ".join(map(str, item.values())) if isinstance(item, Mapping) else repr(item)


def _sampled(written: StudyFile, ranges: Mapping[str, ValueRange]) -> Sequence[Values]:
    """Points of a Latin hypercube over all ranges.

    Each range is divided into as many parts as there are points, and each part contains one point (McKay,
    Beckman and Conover 1979; scipy's generator).
    """
    from scipy.stats import qmc

    assert written.samples is not None
    points = qmc.LatinHypercube(d=len(ranges), seed=written.design_seed).random(written.samples)
    return [
        {path: _within(levels, share) for (path, levels), share in zip(ranges.items(), point, strict=True)}
        for point in points.tolist()
    ]


def _within(levels: ValueRange, share: float) -> float | int:
    """The value at a share, in [0, 1], of a range, to six decimals."""
    if levels.whole:
        low, high = round(levels.from_), round(levels.to)
        return min(low + int(share * (high - low + 1)), high)
    return round(levels.from_ + share * (levels.to - levels.from_), 6)
