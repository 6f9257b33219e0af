"""What the moment rules out: hands that carry something, noise that drowns words, consent that is missing."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from comity_fis.proxemics import PERSON_MARGIN_M

RAISED_VOICE_DB = 66.0
"""A raised voice at 1 m, in dB(A): the vocal effort "raised" of ISO 9921:2003 (from memory, unverified).

That words are useless where the noise is louder than the voice is this project's own choice.
"""

HANDS_OF_PERSON = frozenset({"handshake"})
"""Gestures that need a hand of the person, too (our choice)."""
SPOKEN_TO_M = 1.5
"""Who does not see is spoken to before the robot is nearer than this, between the bodies (our choice: the
zone in which it also slows down)."""
FREE_OF_HANDS = frozenset({"nod", "none"})
"""All that a robot with something in its hands can do: a bow would tip a tray (our choice).

A gesture from a rulebook of other authors is taken to need the hands.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Circumstances:
    """How things stand around one person when they are greeted."""

    robot_carries: str | None = None
    """What the robot has in its hands; None: they are free."""
    person_carries: str | None = None
    """The same of the person."""
    noise_db: float | None = None
    """Around the person, in dB(A); None where nothing is known of it, which counts as quiet."""
    noisy: bool = False
    """Words are useless here, whatever the distance."""
    withheld: Mapping[str, str] = field(default_factory=dict)
    """Gestures that are not permitted, with what they require: consent above all."""
    wants_no_touch: bool = False
    """They asked not to be touched: that, and no lack of consent, is what is withheld."""
    at_rest: Mapping[str, str] = field(default_factory=dict)
    """What they asked for and cannot have now, with why, in words; by parameter."""
    hears: bool = True
    """Who does not is never greeted in words alone."""
    sees: bool = True
    """Who does not is never greeted by a gesture alone; words say that the robot comes, stops, leaves."""
    reach_m: Mapping[str, float] = field(default_factory=dict)
    """How far beyond its body the robot's gestures reach [m], as it states; of others see `reach`."""
    touches: frozenset[str] = frozenset()
    """Gestures of contact: those that need consent to touch."""
    hits: Mapping[str, str] = field(default_factory=dict)
    """Gestures within whose reach something stands where the robot would greet, with what it is, in words."""
    presumes_consent: bool = False
    """As if all that is required were so: only to ask what consent would change, never to act."""

    def against_gesture(self, gesture: str) -> str | None:
        """Why a gesture is out, all reasons joined; None where it is possible."""
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
        """Why a greeting that speaks, shows a gesture, or both is not perceived; None: it is."""
        if (speaks and self.hears) or (shows and self.sees):
            return None
        if not (self.hears or self.sees):
            return "they neither hear nor see, and no act that is shipped reaches them"
        return "they do not hear" if not self.hears else "they do not see"

    def against_coming(self) -> str | None:
        """Why the robot may not come near: who does not see cannot be told that it comes; None: it may."""
        drowned = None if self.sees else self.against_words(SPOKEN_TO_M)
        return drowned and f"they do not see, and could not be told that the robot comes: {drowned}"

    def against_words(self, distance_m: float) -> str | None:
        """Why words are useless at this distance between the bodies; None where they are heard."""
        if self.noisy:
            return "it is too noisy for words"
        # The robot never stands nearer, so the voice is taken to be no louder than there.
        voice_db = RAISED_VOICE_DB - 20.0 * math.log10(max(distance_m, PERSON_MARGIN_M))
        if self.noise_db is None or voice_db >= self.noise_db:
            return None
        return f"noise of {self.noise_db:g} dB drowns a voice of {voice_db:.0f} dB at {distance_m:.2f} m"


QUIET_AND_FREE = Circumstances()
"""Nothing is ruled out."""
