"""Means of episodes with intervals that resample individuals, rooms and seeds, never episodes.

Episodes of one individual resemble each other, and so do those of one room, and those of one seed, whose
noise all individuals share: a thousand episodes are no thousand people. Episodes are first averaged by
individual and room. Individuals, rooms and seeds are then drawn again with replacement, each on its own, and
an episode counts as often as all three were drawn. This is the pigeonhole bootstrap (Owen, "The pigeonhole
bootstrap", Annals of Applied Statistics 1(2), 2007; of more than two factors: Owen and Eckles, "Bootstrapping
data arrays of arbitrary order", Annals of Applied Statistics 6(3), 2012), which is conservative.

Of each factor one fewer is drawn than there are, so that the variance is right for few of them, too (Rao and
Wu, "Resampling inference with complex survey data", Journal of the American Statistical Association 83(401),
1988). What seeds alone add is stated separately, as the Monte Carlo error of the mean.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comity.answers.study_report import EstimateAnswer

Floats = NDArray[np.float64]
Whole = NDArray[np.intp]
Labels = NDArray[Any]

LEVEL = 0.95
"""Of the intervals: the middle share of the resampled means."""
RESAMPLES = 2000
"""The ends of an interval move by about a thirtieth of its width between seeds of the bootstrap."""
SEED = 20261
"""Of the bootstrap; fixed, so that a page is the same each time."""
AT_ONCE = 2_000_000
"""Weights that are held at a time, which bounds memory to 16 MB a table."""


def estimate(
    values: Floats, individuals: Labels, rooms: Labels, repeated: Labels, seeds: Labels
) -> EstimateAnswer | None:
    """The mean of some episodes, with its uncertainty; None without a value.

    Args:
        values: One an episode; NaN where it has none.
        individuals: The individual of each episode.
        rooms: The scenario of each episode.
        repeated: The condition of each episode: episodes of one individual in one room under one condition
            differ by their seed alone.
        seeds: The seed of each episode.
    """
    there = ~np.isnan(values)
    if not there.any():
        return None
    table = averaged(values, individuals, rooms)
    ends = interval(values, individuals, rooms, seeds)
    persons, room_count = table.shape
    return EstimateAnswer(
        mean=float(np.nanmean(table)),
        low=ends and ends[0],
        high=ends and ends[1],
        monte_carlo_error=_monte_carlo_error(
            values[there], individuals[there], rooms[there], repeated[there], seeds[there]
        ),
        episodes=int(there.sum()),
        individuals=persons,
        rooms=room_count,
        seeds=len(np.unique(seeds[there])),
    )


def averaged(values: Floats, individuals: Labels, rooms: Labels) -> Floats:
    """Means of episodes, individuals x rooms in the order of their names; NaN where there is none.

    Args:
        values: One an episode; those that are NaN count not, nor does an individual or a room of them alone.
        individuals: The individual of each episode.
        rooms: The scenario of each episode.
    """
    there = ~np.isnan(values)
    person, persons = numbered(individuals[there])
    room, room_count = numbered(rooms[there])
    cell = person * room_count + room
    sums = np.bincount(cell, weights=values[there], minlength=persons * room_count)
    counts = np.bincount(cell, minlength=persons * room_count)
    means = np.divide(sums, counts, out=np.full(len(sums), math.nan), where=counts > 0)
    table: Floats = means.reshape(persons, room_count)
    return table


def interval(values: Floats, individuals: Labels, rooms: Labels, seeds: Labels) -> tuple[float, float] | None:
    """Ends of the interval for the mean of some episodes; None where there is nothing to resample.

    Args:
        values: One an episode; NaN where it has none.
        individuals: The individual of each episode.
        rooms: The scenario of each episode.
        seeds: The seed of each episode.
    """
    there = ~np.isnan(values)
    person, persons = numbered(individuals[there])
    room, room_count = numbered(rooms[there])
    seed, seed_count = numbered(seeds[there])
    if persons * room_count * seed_count < 2:
        return None
    cell = person * room_count + room
    share = 1 / np.bincount(cell)[cell]  # of an episode in the mean of its individual and room
    middle = float((share * values[there]).sum() / share.sum())
    place, shape = cell * seed_count + seed, (persons, room_count * seed_count)
    weight, off = (  # around the mean: constant values give it to the digit
        np.bincount(place, weights=one, minlength=math.prod(shape)).reshape(shape)
        for one in (share, share * (values[there] - middle))
    )
    means = []
    for by_person, by_room, by_seed in _drawn((persons, room_count, seed_count)):
        by_place = (by_room[:, :, None] * by_seed[:, None, :]).reshape(len(by_room), -1)
        total = ((by_person @ weight) * by_place).sum(axis=1)
        some = total > 0  # a resample of empty cells alone says nothing
        means.append(((by_person @ off) * by_place).sum(axis=1)[some] / total[some])
    low, high = np.quantile(np.concatenate(means), [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    return middle + float(low), middle + float(high)


def _drawn(counts: Sequence[int]) -> Iterator[list[Floats]]:
    """How often each individual, room and seed is drawn: resamples x how many of each there are.

    Each has random numbers of its own: the number of seeds does not change which individuals are drawn.
    """
    randoms = [np.random.default_rng([SEED, i]) for i in range(len(counts))]
    at_once = max(AT_ONCE // max(counts[0], math.prod(counts[1:])), 1)
    for start in range(0, RESAMPLES, at_once):
        size = min(at_once, RESAMPLES - start)
        yield [_times(random, count, size) for random, count in zip(randoms, counts, strict=True)]


def _times(random: np.random.Generator, count: int, size: int) -> Floats:
    """How often each of so many comes up where one fewer is drawn, a row for each resample."""
    found = random.integers(count, size=(size, max(count - 1, 1)))
    places = found + count * np.arange(size)[:, None]
    return np.bincount(places.ravel(), minlength=size * count).reshape(size, count).astype(float)


def _monte_carlo_error(
    values: Floats, individuals: Labels, rooms: Labels, repeated: Labels, seeds: Labels
) -> float | None:
    """Standard error of the mean from seeds alone; individuals and rooms are taken as given.

    Every individual meets the same seeds, so episodes of one seed are not independent of each other: their
    residuals, what is left of each value without the mean of its repeats, are added up seed by seed
    (Liang and Zeger, "Longitudinal data analysis using generalized linear models", Biometrika 73(1), 1986).
    """
    seed, seed_count = numbered(seeds)
    if seed_count < 2:
        return None
    person, _ = numbered(individuals)
    room, room_count = numbered(rooms)
    condition, condition_count = numbered(repeated)
    cell, cells = numbered(person * room_count + room)
    group, groups = numbered(cell * condition_count + condition)
    counts = np.bincount(group, minlength=groups)
    if counts.max() < 2:
        return None
    residuals = values - (np.bincount(group, weights=values, minlength=groups) / counts)[group]
    weights = 1 / (cells * np.bincount(cell, minlength=cells)[cell])
    sums = np.bincount(seed, weights=weights * residuals, minlength=seed_count)
    return math.sqrt(float((sums**2).sum()) * seed_count / (seed_count - 1))


def numbered(labels: NDArray[Any]) -> tuple[Whole, int]:
    """Labels as numbers from 0, and how many there are."""
    found, numbers = np.unique(labels, return_inverse=True)
    return numbers.reshape(-1), len(found)
