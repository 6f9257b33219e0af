"""Means over episodes with bootstrap intervals that resample individuals, rooms and seeds, not episodes.

Episodes of one individual are correlated, and so are those of one room, and those of one seed, whose noise
all individuals share: a thousand episodes are not a thousand people. Episodes are first averaged by
individual and room. Individuals, rooms and seeds are then resampled independently with replacement, and the
weight of an episode is the product of the three counts. This is the pigeonhole bootstrap (Owen, "The
pigeonhole bootstrap", Annals of Applied Statistics 1(2), 2007; for more than two factors: Owen and Eckles,
"Bootstrapping data arrays of arbitrary order", Annals of Applied Statistics 6(3), 2012), which is
conservative.

For n levels of a factor, n - 1 are drawn, so that the variance is right for small n too (Rao and Wu,
"Resampling inference with complex survey data", Journal of the American Statistical Association 83(401),
1988). The contribution of seeds alone is stated separately, as the Monte Carlo error of the mean.
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
"""Confidence level: the middle share of the resampled means."""
RESAMPLES = 2000
"""Number of resamples: the ends of an interval move by about a thirtieth of its width between seeds of the
bootstrap."""
SEED = 20261
"""Seed of the bootstrap; fixed, so that a page is reproducible."""
AT_ONCE = 2_000_000
"""Maximum number of weights held at a time, which bounds memory to 16 MB per table."""


def estimate(
    values: Floats, individuals: Labels, rooms: Labels, repeated: Labels, seeds: Labels
) -> EstimateAnswer | None:
    """The mean over episodes, with its uncertainty; None without a value.

    Args:
        values: One value per episode; NaN if missing.
        individuals: The individual of each episode.
        rooms: The scenario of each episode.
        repeated: The condition of each episode: episodes of one individual in one room under one condition
            differ only in their seed.
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
    """Means of episodes, shape (individuals, rooms), each in the order of names; NaN without episodes.

    Args:
        values: One value per episode; NaN values are ignored, as are individuals or rooms with NaN only.
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
    """Ends of the interval of the mean over episodes; None if there is nothing to resample.

    Args:
        values: One value per episode; NaN if missing.
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
    share = 1 / np.bincount(cell)[cell]  # weight of an episode in the mean of its individual and room
    middle = float((share * values[there]).sum() / share.sum())
    place, shape = cell * seed_count + seed, (persons, room_count * seed_count)
    weight, off = (  # centred: constant values stay exact
        np.bincount(place, weights=one, minlength=math.prod(shape)).reshape(shape)
        for one in (share, share * (values[there] - middle))
    )
    means = []
    for by_person, by_room, by_seed in _drawn((persons, room_count, seed_count)):
        by_place = (by_room[:, :, None] * by_seed[:, None, :]).reshape(len(by_room), -1)
        total = ((by_person @ weight) * by_place).sum(axis=1)
        some = total > 0  # a resample with only empty cells has no mean
        means.append(((by_person @ off) * by_place).sum(axis=1)[some] / total[some])
    low, high = np.quantile(np.concatenate(means), [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    return middle + float(low), middle + float(high)


def _drawn(counts: Sequence[int]) -> Iterator[list[Floats]]:
    """Weights of individuals, rooms and seeds, in chunks: arrays of shape (resamples in the chunk, levels).

    Each factor has its own random stream: the number of seeds does not change which individuals are drawn.
    """
    randoms = [np.random.default_rng([SEED, i]) for i in range(len(counts))]
    at_once = max(AT_ONCE // max(counts[0], math.prod(counts[1:])), 1)
    for start in range(0, RESAMPLES, at_once):
        size = min(at_once, RESAMPLES - start)
        yield [_times(random, count, size) for random, count in zip(randoms, counts, strict=True)]


def _times(random: np.random.Generator, count: int, size: int) -> Floats:
    """Weights when one level fewer than `count` is drawn, shape (size, count)."""
    found = random.integers(count, size=(size, max(count - 1, 1)))
    places = found + count * np.arange(size)[:, None]
    return np.bincount(places.ravel(), minlength=size * count).reshape(size, count).astype(float)


def _monte_carlo_error(
    values: Floats, individuals: Labels, rooms: Labels, repeated: Labels, seeds: Labels
) -> float | None:
    """Standard error of the mean from seeds alone; individuals and rooms are taken as given.

    Every individual meets the same seeds, so episodes of one seed are not independent. Their residuals (each
    value minus the mean of its repetitions) are therefore summed by seed (Liang and Zeger, "Longitudinal data
    analysis using generalized linear models", Biometrika 73(1), 1986).
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
    """Labels as indices from 0, and the number of distinct labels."""
    found, numbers = np.unique(labels, return_inverse=True)
    return numbers.reshape(-1), len(found)
