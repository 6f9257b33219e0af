"""Power analysis: the number of people that a study with people needs.

Two-sided t-tests with equal groups, using the exact power of the noncentral t distribution (Cohen 1988,
Statistical Power Analysis for the Behavioral Sciences, chapter 2), not a normal approximation. The design
effect 1 + (m - 1) * ICC accounts for people in clusters, such as wards (Kish 1965, Survey Sampling).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np

from comity_fis.errors import WrongValueError

MOST = 10_000_000
"""Maximum number of people; a smaller difference is not worth a search."""
NODES = 10_000
"""Nodes of the midpoint rule: within 1e-5 of scipy's noncentral t wherever scipy has a value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PowerQuestion:
    """A difference between two conditions that a study is to detect."""

    difference_cm: float
    """Difference between the means [cm], above 0."""
    sd_cm: float
    """Standard deviation between people [cm], above 0."""
    correlation: float | None = None
    """Correlation of a person's two values if each meets both conditions, in [-1, 1); None for two groups."""
    cluster: int = 1
    """Number of people in each cluster."""
    icc: float = 0.0
    """Intraclass correlation: similarity of people in one cluster, in [0, 1]."""
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
        """Effect size: the difference in standard deviations of people, or of within-person differences."""
        if self.correlation is None:
            return self.difference_cm / self.sd_cm
        return self.difference_cm / (self.sd_cm * sqrt(2 - 2 * self.correlation))

    @property
    def design_effect(self) -> float:
        """Factor by which clusters increase the number of people needed."""
        return 1.0 + (self.cluster - 1) * self.icc


@dataclass(frozen=True, slots=True)
class PeopleNeeded:
    """The number of people that a power question requires."""

    per_group: int
    """People in each of two groups; all people if each meets both conditions."""
    clusters_per_group: int | None
    """Clusters in each group; None without clusters."""
    power_reached: float
    """Power reached with that many people."""


def people_needed(question: PowerQuestion) -> PeopleNeeded:
    """The smallest number of people that reaches the required power.

    Raises:
        WrongValueError: if it takes more than `MOST` people.
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
    while high - low > 1:  # power increases with the number of people
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
    """The probability of detecting the difference with this number of independent people in each group.

    Args:
        question: The difference.
        people: Number of people in each of two groups, or of all who meet both conditions; at least 2.
    """
    from scipy.stats import chi2, norm, t

    is_paired = question.correlation is not None
    freedom = people - 1 if is_paired else 2 * people - 2
    if freedom <= 0:
        return 0.0
    shift = question.effect * sqrt(people if is_paired else people / 2)
    limit = float(t.ppf(1 - question.alpha / 2, freedom))
    # A noncentral t variable is a normal one over the root of a scaled independent chi-square: average the
    # normal's tails beyond the critical value over quantiles of the chi-square. scipy's `nct` has no value
    # far out in the tail.
    levels = (np.arange(NODES) + 0.5) / NODES
    edge = limit * np.sqrt(chi2.ppf(levels, freedom) / freedom)
    return float(np.mean(norm.cdf(shift - edge) + norm.cdf(-shift - edge)))
