"""How many people a study with people needs, before any of them comes.

Two-sided t-tests with equal groups: the power is that of the noncentral t distribution (Cohen 1988,
Statistical Power Analysis for the Behavioral Sciences, chapter 2), no normal approximation. People who come
in clusters, such as wards, count for less by the design effect 1 + (m - 1) * ICC (Kish 1965,
Survey Sampling).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np

from comity_fis.errors import WrongValueError

MOST = 10_000_000
"""People that are looked for; a smaller difference needs another question."""
NODES = 10_000
"""Of the midpoint rule: within 1e-5 of scipy's noncentral t wherever that has a value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PowerQuestion:
    """A difference between two conditions that is to be found."""

    difference_cm: float
    """Between the means, above 0."""
    sd_cm: float
    """Standard deviation between people, above 0."""
    correlation: float | None = None
    """Of one person's two values where each meets both conditions, in [-1, 1); None for two groups."""
    cluster: int = 1
    """People in each cluster."""
    icc: float = 0.0
    """Intraclass correlation: how alike people of one cluster are, in [0, 1]."""
    alpha: float = 0.05
    power: float = 0.80

    def __post_init__(self) -> None:
        for name, low, high in (
            ("difference_cm", 0.0, 1000.0),
            ("sd_cm", 0.0, 1000.0),
            ("alpha", 0.0, 0.5),
            ("power", self.alpha, 1.0),
        ):
            if not low < getattr(self, name) < high:
                raise WrongValueError(
                    expected=f"{name} above {low:g} and below {high:g}",
                    got=f"{getattr(self, name):g}",
                    remedy="Give another number.",
                )
        if self.correlation is not None and not -1.0 <= self.correlation < 1.0:
            raise WrongValueError(
                expected="a correlation from -1 up, below 1",
                got=f"{self.correlation:g}",
                remedy="Take that of one person's two values, such as 0.5.",
            )
        if self.cluster < 1 or not 0.0 <= self.icc <= 1.0:
            raise WrongValueError(
                expected="clusters of 1 or more with an intraclass correlation from 0 to 1",
                got=f"{self.cluster} and {self.icc:g}",
                remedy="Give for example 8 and 0.05.",
            )

    @property
    def effect(self) -> float:
        """The difference in standard deviations of people, or of one person's own difference."""
        if self.correlation is None:
            return self.difference_cm / self.sd_cm
        return self.difference_cm / (self.sd_cm * sqrt(2 - 2 * self.correlation))

    @property
    def design_effect(self) -> float:
        """By which factor more people are needed than without clusters."""
        return 1.0 + (self.cluster - 1) * self.icc


@dataclass(frozen=True, slots=True)
class PeopleNeeded:
    """How many people answer a question about power."""

    per_group: int
    """In each of two groups; where each person meets both conditions, all people."""
    clusters_per_group: int | None
    """None without clusters."""
    power_reached: float
    """With that many people."""


def people_needed(question: PowerQuestion) -> PeopleNeeded:
    """The fewest people with whom the difference is found with the power that is asked for.

    Raises:
        WrongValueError: if it takes more than 10 million.
    """
    low, high = 1, 2
    while power_of(question, high) < question.power:
        low, high = high, 2 * high
        if high > MOST:
            raise WrongValueError(
                expected=f"a difference that fewer than {MOST} people show",
                got=f"{question.difference_cm:g} cm at a spread of {question.sd_cm:g} cm",
                remedy="Ask for a larger difference, or for less power.",
            )
    while high - low > 1:  # power grows with the number of people
        middle = (low + high) // 2
        low, high = (low, middle) if power_of(question, middle) >= question.power else (middle, high)
    people = ceil(round(high * question.design_effect, 9))
    if question.cluster == 1:
        return PeopleNeeded(people, None, power_of(question, high))
    clusters = ceil(people / question.cluster)
    return PeopleNeeded(
        clusters * question.cluster,
        clusters,
        power_of(question, clusters * question.cluster / question.design_effect),
    )


def power_of(question: PowerQuestion, people: float) -> float:
    """The probability to find the difference with so many independent people in each group.

    Args:
        question: The difference.
        people: Each of two groups, or all who meet both conditions; at least 2.
    """
    from scipy.stats import chi2, norm, t

    is_paired = question.correlation is not None
    freedom = people - 1 if is_paired else 2 * people - 2
    if freedom <= 0:
        return 0.0
    shift = question.effect * sqrt(people if is_paired else people / 2)
    limit = float(t.ppf(1 - question.alpha / 2, freedom))
    # The noncentral t is a normal over the root of an independent chi-square: the normal's tails beyond the
    # limit, averaged over the quantiles of the latter. scipy's `nct` has no value far out in the tail.
    levels = (np.arange(NODES) + 0.5) / NODES
    edge = limit * np.sqrt(chi2.ppf(levels, freedom) / freedom)
    return float(np.mean(norm.cdf(shift - edge) + norm.cdf(-shift - edge)))
