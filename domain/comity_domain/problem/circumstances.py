"""Circumstances that exclude options: full hands, noise that drowns words, missing consent."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from comity_fis.proxemics import PERSON_MARGIN_M

RAISED_VOICE_DB = 66.0
"""A raised voice at 1 m, in dB(A): the vocal effort "raised" of ISO 9921:2003 (from memory, unverified).

That words are useless in noise louder than the voice is our choice.
"""

HANDS_OF_PERSON = frozenset({"handshake"})
"""Gestures that also need a free hand of the person (our choice)."""
SPOKEN_TO_M = 1.5
"""Distance between the bodies at which the robot has spoken to a person who cannot see [m] (our choice: the
zone in which it also slows down)."""
FREE_OF_HANDS = frozenset({"nod", "none"})
"""Gestures that a robot with an object in its hands can make: a bow would tip a tray (our choice).

Any other gesture of a rulebook is assumed to need the hands.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Circumstances:
    """Circumstances of one person when they are greeted."""

    robot_carries: str | None = None
    """Object in the robot's hands; None if they are free."""
    person_carries: str | None = None
    """Object in the person's hands; None if they are free."""
    noise_db: float | None = None
    """Noise level at the person [dB(A)]; None if unknown, which counts as quiet."""
    noisy: bool = False
    """Whether words are useless here at any distance."""
    withheld: Mapping[str, str] = field(default_factory=dict)
    """Gestures that are not permitted, each with what it requires, such as consent."""
    wants_no_touch: bool = False
    """Whether the person asked not to be touched: the reason for `withheld`, rather than missing consent."""
    at_rest: Mapping[str, str] = field(default_factory=dict)
    """Requests that cannot be met now, each with the reason in words, by parameter."""
    hears: bool = True
    """Whether the person hears; if not, a greeting never consists of words alone."""
    sees: bool = True
    """Whether the person sees; if not, no greeting is a gesture alone, and the robot announces its
    motions."""
    reach_m: Mapping[str, float] = field(default_factory=dict)
    """Reach of the robot's gestures beyond its body [m], as it states; `reach` has the defaults."""
    touches: frozenset[str] = frozenset()
    """Gestures of contact, which need consent to touch."""
    hits: Mapping[str, str] = field(default_factory=dict)
    """Gestures that would hit an obstacle at the greeting pose, each with the obstacle in words."""
    presumes_consent: bool = False
    """Assume that all requirements are met: only to ask what consent would change, never to act."""

    def against_gesture(self, gesture: str) -> str | None:
        """Why a gesture is excluded, all reasons joined; None if it is possible."""
        reasons = []
        if gesture in self.withheld and not self.presumes_consent:
            reasons.append(self._against_withheld(self.withheld[gesture]))
        if self.robot_carries and gesture not in FREE_OF_HANDS:
            reasons.append(f"the robot carries {self.robot_carries}")
        if self.person_carries and gesture in HANDS_OF_PERSON:
            reasons.append(f"the person carries {self.person_carries}")
        return ", and ".join(reasons) or None

    def _against_withheld(self, required: str) -> str:
        if self.wants_no_touch and "touch_consent" in required:
            return "they asked for no touch"
        return f"it requires that {required.replace('_', ' ')}"

    def against_modality(self, *, speaks: bool, shows: bool) -> str | None:
        """Why a greeting with speech, a gesture or both is not perceived; None if it is."""
        if (speaks and self.hears) or (shows and self.sees):
            return None
        if not (self.hears or self.sees):
            return "they neither hear nor see, and no act that is shipped reaches them"
        return "they do not hear" if not self.hears else "they do not see"

    def against_coming(self) -> str | None:
        """Why the robot may not approach: a person who cannot see cannot be told; None if it may."""
        drowned = None if self.sees else self.against_words(SPOKEN_TO_M)
        return drowned and f"they do not see, and could not be told that the robot comes: {drowned}"

    def against_words(self, distance_m: float) -> str | None:
        """Why words are useless at this distance between the bodies [m]; None if they are heard."""
        if self.noisy:
            return "it is too noisy for words"
        # The robot never stands closer, so the voice is assumed to be no louder than at this distance.
        voice_db = RAISED_VOICE_DB - 20.0 * math.log10(max(distance_m, PERSON_MARGIN_M))
        if self.noise_db is None or voice_db >= self.noise_db:
            return None
        return f"noise of {self.noise_db:g} dB drowns a voice of {voice_db:.0f} dB at {distance_m:.2f} m"


QUIET_AND_FREE = Circumstances()
"""Nothing is excluded."""
