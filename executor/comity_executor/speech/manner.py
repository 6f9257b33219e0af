"""The manner of an act: volume and rate of speech, amplitude of gestures."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from comity_fis.errors import InputError
from comity_fis.inference.value import Inference

NORMAL_VOLUME, NORMAL_RATE, NORMAL_AMPLITUDE = 0.5, 1.0, 0.5
"""Defaults if a rulebook has no such parameter (our choice: the neutral values of the rulebook
`evidence`)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Manner:
    """The manner of one act; a robot uses what applies to the act."""

    volume: float = NORMAL_VOLUME
    """Volume of the voice, as a share of the loudspeaker's range, in [0, 1]."""
    rate: float = NORMAL_RATE
    """Speech rate, as a multiple of the normal rate, above 0."""
    amplitude: float = NORMAL_AMPLITUDE
    """Amplitude of a gesture, as a share of the largest one, in [0, 1]."""

    def __post_init__(self) -> None:
        _require("voice_volume", self.volume, "a number in 0..1", 0 <= self.volume <= 1)
        _require("speech_rate", self.rate, "a fraction of the normal rate, above 0", self.rate > 0)
        _require("gesture_amplitude", self.amplitude, "a number in 0..1", 0 <= self.amplitude <= 1)


def manner_of(values: Inference) -> Manner:
    """The manner that suits one person.

    Raises:
        InputError: If a rulebook uses one of these parameters with another meaning.
    """
    return Manner(
        volume=_number(values, "voice_volume", NORMAL_VOLUME),
        rate=_number(values, "speech_rate", NORMAL_RATE),
        amplitude=_number(values, "gesture_amplitude", NORMAL_AMPLITUDE),
    )


def _number(values: Inference, parameter: str, otherwise: float) -> float:
    if parameter not in values.parameters:
        return otherwise
    value = values[parameter].value
    if isinstance(value, str):
        raise _refusal(parameter, value, "a number")
    return value


def _require(parameter: str, value: float, expected: str, holds: bool) -> None:
    if not (isfinite(value) and holds):
        raise _refusal(parameter, value, expected)


def _refusal(parameter: str, value: float | str, expected: str) -> InputError:
    return InputError(
        expected=f"{parameter} as {expected}",
        got=repr(value),
        remedy="The robot's acts read this parameter; give the rulebook's another name, or this meaning.",
    )


NORMAL = Manner()
