"""What a person explicitly asked for: a hard constraint on the plan."""

from __future__ import annotations

from comity_fis.inference.value import ParameterValue


def is_setting(value: ParameterValue) -> bool:
    """Whether the person asked for the value, even if safety clamped it afterwards."""
    return value.origin == "setting" or any(part.origin == "setting" for part in value.contributions)
