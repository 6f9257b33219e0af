"""Checks whether a real robot may pass people at the scenario's reduced margin."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from math import hypot, isfinite
from numbers import Real
from typing import TYPE_CHECKING

from comity_executor import MarginStatement
from comity_fis import InputError
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.base.drive import REDUCED_M_S
from comity_sim2d.robot.reduced_margin import BODY_MARGIN_M, margin_for_m

if TYPE_CHECKING:
    from comity.scenario import ScenarioFile
    from comity_executor import MapRobot

OPTION = "--reduced-margin"
STATEMENT = "reduced_margin"
"""Attribute of a robot's capabilities."""
POSITIVE = ("braking_m_s2",)


def require_reduced_margin(file: ScenarioFile, base: MapRobot) -> None:
    """Reject a real robot that is not allowed, or not able, to pass people nearer than 0.30 m.

    Args:
        file: The scenario, with the operator's permission.
        base: The robot, with its stated capabilities.

    Raises:
        InputError: The scenario sets a reduced margin, but the operator does not allow it, the robot does not
            state the required values, or they do not suffice for the margin.
    """
    margin_m = file.scenario.robot.margin_m
    if margin_m >= PERSON_MARGIN_M:
        return
    where = file.where("robot", "margin_m")
    if missing := [*_not_allowed(file), *_not_stated(base)]:
        raise InputError(
            expected=f"margin_m of {PERSON_MARGIN_M:g} before a real robot, unless its operator allows less "
            "and it states its latency, braking and tracking errors",
            got="\n  ".join((f"{margin_m:g}, and these are missing:", *missing)),
            remedy=f"Leave `margin_m` out, or give `{OPTION}` with a robot whose capabilities have "
            f"`{STATEMENT}` (docs/how-to/connect-a-robot.md).",
            where=where,
        )
    least_m = kept_margin_m(base)
    if margin_m < least_m:
        raise InputError(
            expected=f"at least {least_m:.3f} m, which is {BODY_MARGIN_M:g} m and what the latency, braking "
            f"and tracking that this robot states add at {REDUCED_M_S:g} m/s",
            got=f"{margin_m:g}",
            remedy="Set at least that."
            if least_m < PERSON_MARGIN_M
            else f"Leave `margin_m` out: this robot cannot keep less than {PERSON_MARGIN_M:g} m.",
            where=where,
        )


def kept_margin_m(base: MapRobot) -> float:
    """Smallest margin that a robot can keep by its statement [m]; the full margin if values are missing.

    Latency and braking are the worse of those in `reduced_margin` and in the other capabilities.
    """
    if _not_stated(base):
        return PERSON_MARGIN_M
    can = base.capabilities
    stated = _statement(base)
    return margin_for_m(
        max(stated.latency_s, can.latency_s),
        min(stated.braking_m_s2, can.braking_m_s2),
        hypot(stated.tracker_sd_m, stated.path_sd_m),
    )


def tracker_sd_m(base: MapRobot) -> float:
    """Standard deviation of a person's position as stated by the robot [m]; 0 if not stated."""
    return 0.0 if _not_stated(base) else _statement(base).tracker_sd_m


def _statement(base: MapRobot) -> MarginStatement:
    stated: MarginStatement = getattr(base.capabilities, STATEMENT)
    return stated


def _not_allowed(file: ScenarioFile) -> Iterator[str]:
    if not file.reduced_margin:
        yield f"`{OPTION}`, by which the robot's operator allows it"


def _not_stated(base: MapRobot) -> list[str]:
    """Required values that are missing or invalid."""
    stated = getattr(base.capabilities, STATEMENT, None)
    if stated is None:
        return [f"capabilities.{STATEMENT} of the robot: it does not take a margin with its goals"]
    found = []
    for field in fields(MarginStatement):
        value = getattr(stated, field.name, None)
        number = float(value) if isinstance(value, Real) and not isinstance(value, bool) else -1.0
        if isfinite(number) and (number > 0.0 or (number == 0.0 and field.name not in POSITIVE)):
            continue
        least = "above 0" if field.name in POSITIVE else "of 0 or more"
        found.append(f"capabilities.{STATEMENT}.{field.name}: a number {least}, not {value!r}")
    return found
