"""The study of learning with people: populations that the model describes, and others that it does not.

`python tests/comfort_study.py` prints the table of docs/explanation/learning.md. There is no physics here:
the robot stands exactly where it wants to. Signals are drawn and weighed by the code that the world and the
robot use; tests/comity/test_learning_study.py ties the two. All populations are invented.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

from comity_fis.learning.comfort import EDGE, ComfortPosterior
from comity_fis.learning.showing import MISREAD, drawn, misread, shown

Floats = NDArray[np.float64]

SPREAD_M = 0.30
CHANCES: Floats = np.array([0.0, 0.3, 0.6, 0.9])
CHANCE_WEIGHTS: Floats = np.array([0.15, 0.25, 0.35, 0.25])
"""How often these people show a discomfort at all. The robot allows for more who never do: its doubts are its
own."""
HELD_OUT = 2001
"""The first seed of the table. What the robot believes and fears was set with seeds from 101 to 108; the
people of the table were met for the table alone."""
SAMPLES = 10
COUNTRIES_M = SPREAD_M / 3
"""People vary about three times as much as countries do; so much do right culture values differ here."""
ANSWER_M = 0.10
"""How far off a person is who is asked once for the distance they like: our assumption."""
NEEDED_M = 0.05
"""Worse than before by less is not called worse."""
REVERSED = np.array([3, 4, 2, 0, 1, 5])
"""The signal that a contrary person shows, by the one that others would."""


@dataclass(frozen=True, slots=True)
class Population:
    """How people differ from the model's value."""

    text: str
    bias_m: float = 0.0
    heavy_tails: bool = False
    trend_m: float = 0.0
    """By so much everybody changes from visit to visit, half of them either way."""
    chances: Floats = field(default_factory=lambda: CHANCE_WEIGHTS)
    contrary_moments: float = 0.0
    """The share of signals that say the opposite."""
    contrary_people: float = 0.0
    """The share of people all of whose signals do."""


POPULATIONS: Mapping[str, Population] = {
    "well specified": Population("as the model has it without its doubts"),
    "biased, farther": Population("all like 20 cm more than the model says", bias_m=0.20),
    "biased, nearer": Population("all like 20 cm less", bias_m=-0.20),
    "heavy tails": Population("Student's t with 2.5 degrees of freedom", heavy_tails=True),
    "drifting": Population("everybody changes by 3 cm from visit to visit, for good", trend_m=0.03),
    "silent": Population(
        "nobody shows anything; what is noticed is misread", chances=np.array([1.0, 0.0, 0.0, 0.0])
    ),
    "contrary moments": Population("15 % of all signals say the opposite", contrary_moments=0.15),
    "contrary people": Population("every tenth person says the opposite, always", contrary_people=0.10),
    "contrary all": Population("everybody says the opposite, always", contrary_people=1.0),
}
BEYOND = ("contrary all",)
"""Populations with which learning fails: whoever believes what they show goes the wrong way."""


@dataclass(frozen=True, slots=True)
class Result:
    """What came of one population; arrays are by visit."""

    error_m: Floats
    """Mean absolute error of the learner."""
    prior_m: Floats
    """Of the culture's value alone."""
    constant_m: Floats
    """Of one distance for everybody."""
    asked_m: Floats
    """Of one question, asked before the first visit, and its answer kept."""
    coverage: Floats
    """Share of people whose liked distance lay in the 90 % interval."""
    worse: Floats
    """Share of people who stood worse than with the prior by more than `NEEDED_M`."""
    intrusions: Floats
    """Share of people to whom the robot came too close."""
    prior_intrusions: Floats


def study(
    population: Population, *, people: int = 500, visits: int = 10, days: float = 30.0, seed: int = 0
) -> Result:
    """Visit every person of a population, and learn."""
    rng = np.random.default_rng(seed)
    culture = COUNTRIES_M * rng.standard_normal(people)
    liked = population.bias_m + SPREAD_M * _standardised(rng, population, people)
    half = 0.5 * SPREAD_M * np.exp(0.4 * rng.standard_normal(people))
    chance = rng.choice(CHANCES, people, p=population.chances)
    contrary = rng.random(people) < population.contrary_people
    trend = population.trend_m * np.where(rng.random(people) < 0.5, -1.0, 1.0)
    answer = liked + ANSWER_M * rng.standard_normal(people)
    known, rows = ComfortPosterior.before_meeting(SPREAD_M, (people,)), []
    for visit in range(visits):
        if visit:
            known, liked = known.later(days), liked + trend
        rows.append(_row(known, liked, half, culture, answer))
        at = known.offset
        probabilities = shown(at, liked - half, liked + half, chance=chance, edge=EDGE * SPREAD_M)
        signals = drawn(misread(probabilities), rng.random(people))
        turned = contrary | (rng.random(people) < population.contrary_moments)
        known = known.after(np.where(turned, REVERSED[signals], signals), at)
    return Result(*np.array(rows).T)


def _standardised(rng: np.random.Generator, population: Population, people: int) -> Floats:
    """Heavy tails are scaled to the same middle half as the normal distribution's."""
    return (
        rng.standard_t(2.5, people) * 0.674 / 0.741 if population.heavy_tails else rng.standard_normal(people)
    )


def _row(
    known: ComfortPosterior, liked: Floats, half: Floats, culture: Floats, answer: Floats
) -> list[float]:
    """One visit, in the order of `Result`; 0 is everybody's own model value."""
    at = known.offset
    low, high = known.interval()
    error, prior = np.abs(at - liked), np.abs(liked)
    return [
        error.mean(),
        prior.mean(),
        np.abs(liked + culture).mean(),
        np.abs(answer - liked).mean(),
        ((low <= liked) & (liked <= high)).mean(),
        (error > prior + NEEDED_M).mean(),
        (at < liked - half).mean(),
        (liked - half > 0.0).mean(),
    ]


def mean_of_samples(population: Population, *, samples: int = SAMPLES) -> Result:
    """The study of several samples of 500 people, averaged."""
    results = [study(population, seed=HELD_OUT + sample) for sample in range(samples)]
    means = {
        each.name: np.mean([getattr(result, each.name) for result in results], axis=0)
        for each in fields(Result)
    }
    return Result(**means)


def table() -> Iterator[str]:
    """The table of the documentation."""
    yield (
        "| population | prior | constant | asked once | visit 1 | visit 2 | visit 4 | visit 10 "
        "| in the interval | worse | too close | with the prior |"
    )
    yield "|---" * 12 + "|"
    for name, population in POPULATIONS.items():
        got = mean_of_samples(population)
        errors = " | ".join(f"{100 * got.error_m[visit - 1]:.1f}" for visit in (1, 2, 4, 10))
        yield (
            f"| {name} | {100 * got.prior_m[-1]:.1f} | {100 * got.constant_m[-1]:.1f} "
            f"| {100 * got.asked_m[-1]:.1f} | {errors} | {100 * got.coverage[-1]:.0f} % "
            f"| {100 * got.worse[-1]:.1f} % | {100 * got.intrusions.mean():.1f} % "
            f"| {100 * got.prior_intrusions.mean():.1f} % |"
        )


if __name__ == "__main__":
    print(f"{SAMPLES} samples of 500 people each, misread {MISREAD:.0%}; mean absolute errors in cm")
    print(*table(), sep="\n")
