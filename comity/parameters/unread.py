"""Notes on behaviour parameters that no action of Comity reads; they are for the robot to use."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_domain.problem.bound_parameters import BOUND, DISTANCE

if TYPE_CHECKING:
    from comity_fis import Inference, Rulebook


def notes_of_unread(rulebook: Rulebook) -> tuple[str, ...]:
    """A note about each behaviour parameter that no action reads.

    A rulebook without a conversational distance is not for visits and gets no note.
    """
    if DISTANCE not in rulebook.parameters:
        return ()
    return tuple(
        f"{name}: neither an action of Comity nor the simulated robot reads it; "
        "a robot of yours receives it by this name."
        for name, parameter in rulebook.parameters.items()
        if parameter.kind == "behaviour" and name not in BOUND
    )


def noting_unread(inference: Inference, rulebook: Rulebook) -> Inference:
    """The inference with these notes added."""
    return replace(inference, notes=(*inference.notes, *notes_of_unread(rulebook)))
