"""Equality across all profiles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes
from comity.testing.amounts.amount import told
from comity.testing.amounts.quantity import require_parameter
from comity.testing.expectation import Finding, ProfileComparison

if TYPE_CHECKING:
    from comity.testing.measuring.compared_profiles import ComparedProfiles

TOPICS = ("safety", "outcome", "order")


@dataclass(frozen=True, slots=True)
class ProfileSameness(ProfileComparison):
    """`safety` (the same limits, kept), `outcome`, `order` of the visits, or a parameter."""

    RULE: ClassVar[str] = "_SAME_FOR_ALL names"
    EXAMPLE: ClassVar[str] = "same for all: safety"

    topics: tuple[str, ...]

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from the names of topics."""
        (topics,) = parts
        return cls(tuple(topics))

    def compare(self, compared: ComparedProfiles) -> Iterator[Finding]:
        """Every topic in which profiles differ."""
        for topic in self.topics:
            if topic == "safety":
                yield from _unsafe(compared)
            elif topic in TOPICS:
                yield from _differing(topic, compared)
            else:
                yield from _differing_parameter(topic, compared)


def _unsafe(compared: ComparedProfiles) -> Iterator[Finding]:
    for one in compared.measured():
        for danger in one.dangers:
            yield Finding(f"{danger.limit}, for everybody", f"{danger.got} for {one.profile}", danger.because)


def _differing(topic: str, compared: ComparedProfiles) -> Iterator[Finding]:
    groups: dict[str, list[str]] = {}
    for one in compared.measured():
        what = one.outcome if topic == "outcome" else ", then ".join(one.order)
        groups.setdefault(what, []).append(one.profile)
    if len(groups) > 1:
        got = "; ".join(f"{what or 'nobody'} for {', '.join(names)}" for what, names in groups.items())
        yield Finding(f"one {topic} for all", got)


def _differing_parameter(parameter: str, compared: ComparedProfiles) -> Iterator[Finding]:
    groups: dict[str, list[str]] = {}
    because: list[str] = []
    for case in compared.across.cases:
        values = compared.values(case.profile_name)
        require_parameter(parameter, values, TOPICS)
        value = told(values[parameter].value, values[parameter].unit)
        if value not in groups:
            because += causes.of_value(values, parameter, case.profile_name)
        groups.setdefault(value, []).append(case.profile_name)
    if len(groups) > 1:
        got = "; ".join(f"{value} for {', '.join(names)}" for value, names in groups.items())
        yield Finding(f"one {parameter} for all", got, tuple(because))
