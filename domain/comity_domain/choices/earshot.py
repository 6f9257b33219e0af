"""Whether words carry to a person: their own distance chooses among ways, and never who is served.

How far off a person likes the robot to stand is cultural, and decides whether it speaks or only gestures.
Where nothing else is left than words, that distance has no say: a person is left out for the noise only where
it drowns words at the nearest distance that rules give, or at the one that they asked for themselves.
"""

from __future__ import annotations

from comity_domain.problem.circumstances import Circumstances
from comity_domain.problem.setting import is_setting
from comity_fis.inference.value import Inference
from comity_fis.proxemics import COMFORT_M


def drowned(values: Inference, now: Circumstances) -> str | None:
    """Why words are useless at this person's distance; None where they are heard."""
    return now.against_words(values["conversational_distance"].number)


def unheard(values: Inference, now: Circumstances) -> str | None:
    """Why words are useless whatever the person's culture; None where they may be the last resort."""
    distance = values["conversational_distance"]
    return now.against_words(distance.number if is_setting(distance) else min(distance.number, COMFORT_M))
