"""Dependencies of a parameter: the variables and parameters that its rules read, also indirectly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_fis.inference.value import Inference
from comity_fis.rulebook.rulebook import Rulebook


@dataclass(frozen=True, slots=True)
class Dependencies:
    """Everything that can affect one parameter of one person."""

    inputs: tuple[str, ...]
    """Variables, in declared order."""
    parameters: tuple[str, ...]
    """The parameter itself, then those it depends on."""
    reads: Mapping[str, tuple[str, ...]]
    """What each parameter's rules read directly; empty if a setting replaced the rules."""


def reading(rulebook: Rulebook, inference: Inference, parameter: str) -> Dependencies:
    """The dependencies of a parameter, given this person's settings."""
    reads: dict[str, tuple[str, ...]] = {}
    waiting = [parameter]
    while waiting:
        name = waiting.pop(0)
        if name not in reads:
            reads[name] = _own_reads(rulebook, inference, name)
            waiting += [read for read in reads[name] if read in rulebook.parameters]
    reached = {name for names in reads.values() for name in names}
    return Dependencies(tuple(name for name in rulebook.variables if name in reached), tuple(reads), reads)


def _own_reads(rulebook: Rulebook, inference: Inference, name: str) -> tuple[str, ...]:
    if inference[name].asked_for:
        return ()
    shift = rulebook.program.shifts.get(name)
    return (*rulebook.program.blocks[name].needs, *(shift.reads if shift else ()))
