"""Behaviour parameters that a rulebook decides and no action reads: they are inferred, and change nothing."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity.parameters.passing import DISTANCE
from comity_executor.speech.manner import ABOUT_GESTURES, ABOUT_SPEECH

if TYPE_CHECKING:
    from comity_fis import Inference, Rulebook

READ = frozenset({DISTANCE, "approach_speed", *ABOUT_SPEECH, *ABOUT_GESTURES})
"""What the actions of a visit read of a person's behaviour parameters."""


def notes_of_unread(rulebook: Rulebook) -> tuple[str, ...]:
    """A note about each behaviour parameter that no action reads.

    A rulebook without a conversational distance is not for visits, and gets no note.
    """
    if DISTANCE not in rulebook.parameters:
        return ()
    return tuple(
        f"{name}: no action reads it, so that it changes nothing in a visit."
        for name, parameter in rulebook.parameters.items()
        if parameter.kind == "behaviour" and name not in READ
    )


def noting_unread(inference: Inference, rulebook: Rulebook) -> Inference:
    """The same inference, with these notes."""
    return replace(inference, notes=(*inference.notes, *notes_of_unread(rulebook)))
