"""Audibility of words: a person's own distance affects how they are greeted, but never whether.

The distance that a person likes is cultural, and decides whether the robot speaks or only gestures. If only
words are possible, it is ignored: a person is left out because of noise only if it drowns words at the
shortest distance that rules give, or at the one that they asked for themselves.
"""

from __future__ import annotations

from comity_domain.problem.circumstances import Circumstances
from comity_domain.problem.setting import is_setting
from comity_fis.inference.value import Inference
from comity_fis.proxemics import COMFORT_M


def drowned(values: Inference, now: Circumstances) -> str | None:
    """Why words are inaudible at this person's distance; None if they are heard."""
    return now.against_words(values["conversational_distance"].number)


def unheard(values: Inference, now: Circumstances) -> str | None:
    """Why words are inaudible whatever the person's culture; None if they may be the last resort."""
    distance = values["conversational_distance"]
    return now.against_words(distance.number if is_setting(distance) else min(distance.number, COMFORT_M))
