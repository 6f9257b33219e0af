"""Partial pooling: estimates for a person, their group and everyone, each weighted by its reliability.

A value is the mean of everyone, plus effects of the group and of the person, plus the noise of one answer.
Each part has a variance of its own, estimated from the data (empirical Bayes: Efron and Morris, "Stein's
estimation rule and its competitors", Journal of the American Statistical Association 68, 1973; Gelman and
Hill, "Data Analysis Using Regression and Multilevel Models", 2007, chapter 12). Estimates from few answers
are shrunk towards the next wider level: a person's towards their group's, a group's towards everyone's,
everyone's towards 0, the value before there were data.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Hashable, Iterable, Mapping
from dataclasses import dataclass
from math import fsum, sqrt

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

DECLARED_PEOPLE = 4
"""Number of people that the declared standard deviation counts for, in addition to the people measured (our
choice)."""
LEAST_PEOPLE = 3
"""Minimum number of people for reporting a group: a smaller one would reveal what one person said (our
choice)."""
STEPS = 60
"""Number of grid points for each standard deviation, denser near 0."""


@dataclass(frozen=True, slots=True)
class StatedOffset:
    """One person's answer, minus the value before."""

    person: Hashable
    group: str | None
    """The group; None if unknown."""
    offset: float


@dataclass(frozen=True, slots=True)
class GroupPrior:
    """The estimate for one group."""

    people: int
    mean: float
    """Mean of its people's means."""
    offset: float
    """What to expect of a new person of this group."""
    standard_error: float
    """Standard error of `mean`."""

    @property
    def is_thin(self) -> bool:
        """Whether the group is too small to report without revealing one or two people."""
        return self.people < LEAST_PEOPLE


@dataclass(frozen=True, slots=True, kw_only=True)
class PooledPrior:
    """What to expect of people, all in one unit, as offsets from what stood before."""

    everybody: float
    """Expected offset of a person whose group is unknown or was not asked."""
    groups: Mapping[str, GroupPrior]
    between_groups: float
    """Standard deviation."""
    between_people: float
    """The same, of people of one group: what no group tells; the declared one is counted in."""
    seen_between_people: float | None
    """The same, by the answers alone; None where no group has two people."""
    declared_spread: float
    """The same, that stood before."""
    within_person: float | None
    """The same, of answers of one person; None where nobody gave two."""
    people: int

    def expected(self, group: str | None) -> float:
        """Of a new person."""
        found = None if group is None else self.groups.get(group)
        return self.everybody if found is None else found.offset

    def known(self, group: str | None, answers: Iterable[float]) -> float:
        """Of one person who gave these answers, as offsets; as of a new person where nobody gave two."""
        given = list(answers)
        expected = self.expected(group)
        if not given or self.within_person is None:
            return expected
        return expected + self.trust(len(given)) * (fsum(given) / len(given) - expected)

    def trust(self, answers: int) -> float:
        """The share that a person's own answers have in what is expected of them, in [0, 1]."""
        if self.within_person is None:
            return 0.0
        return self.between_people**2 / (self.between_people**2 + self.within_person**2 / answers)


def pooled(answers: Iterable[StatedOffset], *, declared_spread: float, widest: float) -> PooledPrior:
    """The prior that answers give.

    Args:
        answers: At least one.
        declared_spread: Standard deviation between people that stood before, above 0.
        widest: A standard deviation that no group is beyond, in the same unit, above 0.
    """
    # Variances are taken from the inside out: answers within a person, means of people within a group,
    # means of groups. Each level's variance contains that of the level below divided by its count, which is
    # taken off, so that chance in few answers does not pass for a difference between people. Each mean then
    # moves towards the next wider one by the share of its variance that is chance (Efron and Morris 1973):
    # a group of three stays near everybody's value, a group of three hundred at its own. The declared
    # spread counts like a few people, so that two people who agree by chance do not make everybody alike.
    people: dict[tuple[Hashable, str | None], list[float]] = defaultdict(list)
    for answer in answers:
        people[answer.person, answer.group].append(answer.offset)
    within = _within(people.values())
    groups: dict[str | None, list[float]] = defaultdict(list)
    for (_, group), given in people.items():
        groups[group].append(fsum(given) / len(given))
    of_means = _between_people(groups.values(), declared_spread, DECLARED_PEOPLE)
    chance = 0.0 if within is None else within * float(np.mean([1 / len(given) for given in people.values()]))
    means = np.array([fsum(given) / len(given) for given in groups.values()])
    variances = np.array([of_means / len(given) for given in groups.values()])
    between_groups, everybody, offsets = _shrunk(means, variances, widest, named=None not in groups)
    return PooledPrior(
        everybody=everybody,
        groups={
            group: GroupPrior(len(groups[group]), float(mean), float(offset), float(variance) ** 0.5)
            for group, mean, offset, variance in zip(groups, means, offsets, variances, strict=True)
            if group is not None
        },
        between_groups=between_groups,
        between_people=max(of_means - chance, 0.05 * of_means) ** 0.5,
        seen_between_people=_seen(groups.values(), chance),
        declared_spread=declared_spread,
        within_person=None if within is None else within**0.5,
        people=len(people),
    )


def _within(people: Iterable[list[float]]) -> float | None:
    """Variance of one person's answers; None where nobody gave two."""
    squares, freedom = 0.0, 0
    for given in people:
        squares += _squares(given)
        freedom += len(given) - 1
    return squares / freedom if freedom else None


def _seen(groups: Collection[list[float]], chance: float) -> float | None:
    """Standard deviation of people in one group, less what answers vary by; None without two of a group."""
    if all(len(means) < 2 for means in groups):
        return None
    return sqrt(max(_between_people(groups, 0.0, 0) - chance, 0.0))


def _between_people(groups: Iterable[list[float]], declared: float, declared_people: int) -> float:
    """Variance of people's means in one group, with the declared one counting for some people."""
    squares, freedom = declared_people * declared**2, float(declared_people)
    for means in groups:
        squares += _squares(means)
        freedom += len(means) - 1
    return squares / freedom


def _squares(numbers: list[float]) -> float:
    """About their mean."""
    mean = fsum(numbers) / len(numbers)
    return fsum((number - mean) ** 2 for number in numbers)


def _shrunk(means: Floats, variances: Floats, widest: float, *, named: bool) -> tuple[float, float, Floats]:
    """The standard deviation between groups, everybody's offset and each group's, drawn together.

    Args:
        means: Of the groups.
        variances: Of these means, above 0.
        widest: The largest standard deviation to look at.
        named: Whether each group has a name: one alone says nothing about everybody then.
    """
    if len(means) == 1:
        between = max(float(means[0] ** 2 - variances[0]), 0.0)  # its most likely value
        offset = means * between / (between + variances)
        return between**0.5, 0.0 if named else float(offset[0]), offset
    # Marginal likelihood of the means, N(0, of_all + diag(of_groups + variances)), over both variances.
    grid = (widest * np.linspace(0, 1, STEPS) ** 2) ** 2
    precision = 1 / (grid[:, None] + variances)
    total = precision.sum(axis=1)
    centre = (precision * means).sum(axis=1) / total
    scatter = (precision * (means - centre[:, None]) ** 2).sum(axis=1)
    of_centre = grid[None, :] + (1 / total)[:, None]
    surprise = (
        (scatter - np.log(precision).sum(axis=1) + np.log(total))[:, None]
        + np.log(of_centre)
        + centre[:, None] ** 2 / of_centre
    )
    of_groups, of_all = np.unravel_index(int(surprise.argmin()), surprise.shape)
    between, all_variance = float(grid[of_groups]), float(grid[of_all])
    everybody = float(centre[of_groups]) * all_variance / (all_variance + 1 / float(total[of_groups]))
    offsets: Floats = everybody + (means - everybody) * between / (between + variances)
    return between**0.5, everybody, offsets
