"""The signals by which people show that another stands too close or too far."""

from __future__ import annotations

from typing import Literal, get_args

Signal = Literal["step_back", "ask_farther", "turn_away", "lean_in", "ask_closer", "nothing"]
"""What a person does within a few seconds of another coming to rest before them."""

SIGNALS: tuple[Signal, ...] = get_args(Signal)
AWAY: frozenset[Signal] = frozenset({"step_back", "ask_farther"})
"""They say: too close."""
MOVED: frozenset[Signal] = frozenset({"step_back", "turn_away", "lean_in"})
"""They are seen."""

WORDS: dict[Signal, str] = {
    "ask_farther": "A little farther, please.",
    "ask_closer": "A little closer, please.",
}
"""They are heard."""

SAID: dict[Signal, str] = {
    "step_back": "stepped back",
    "ask_farther": "asked for more distance",
    "turn_away": "turned away",
    "lean_in": "leaned in",
    "ask_closer": "asked to come closer",
    "nothing": "showed nothing",
}
"""As a sentence about the person says it."""
