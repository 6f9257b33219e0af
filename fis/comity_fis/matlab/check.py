"""Differences between an exported rulebook and the original, over a sample of inputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NominalVariable, Variable

SAMPLES = 200
PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29)


@dataclass(frozen=True, slots=True)
class Comparison:
    """The largest differences found."""

    inputs: int
    """Number of sampled inputs."""
    differences: Mapping[str, float]
    """Largest difference of every parameter, in its own unit."""


def compare(rulebook: Rulebook, exported: Rulebook, samples: int = SAMPLES) -> Comparison:
    """Infer with both rulebooks for inputs spread evenly over all variables (Halton 1960), all known.

    Args:
        rulebook: A rulebook with numeric parameters.
        exported: The exported rulebook, read back; categories are codes from 1 there.
        samples: Number of inputs.
    """
    worst = dict.fromkeys(rulebook.parameters, 0.0)
    for n in range(1, samples + 1):
        places = {
            name: _halton(n, PRIMES[i] if i < len(PRIMES) else 31 + 2 * i)
            for i, name in enumerate(rulebook.variables)
        }
        drawn = {name: _drawn(rulebook.variables[name], place) for name, place in places.items()}
        ours = rulebook.infer({name: value for name, (value, _) in drawn.items()})
        theirs = exported.infer({name: code for name, (_, code) in drawn.items()})
        for name, parameter in rulebook.parameters.items():
            if isinstance(parameter, NumericParameter):
                worst[name] = max(worst[name], abs(ours[name].number - theirs[name].number))
    return Comparison(samples, worst)


def _drawn(variable: Variable, place: float) -> tuple[float | str, float]:
    """The value at a quantile `place` in [0, 1) of the variable's domain, and its value in the export."""
    if isinstance(variable, NominalVariable):
        index = int(place * len(variable.categories))
        return variable.categories[index], index + 1.0
    low, high = variable.domain.ends
    value = variable.domain.clamp(low + place * (high - low))
    return value, value


def _halton(n: int, base: int) -> float:
    """The n-th number of the van der Corput sequence to a base, in [0, 1)."""
    place, part = 0.0, 1.0
    while n:
        part /= base
        n, digit = divmod(n, base)
        place += digit * part
    return place
