"""A walk: the points that a person goes to, one after the other, and how."""

from __future__ import annotations

from dataclasses import dataclass

from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.pose import XY
from comity_sim2d.scene_error import NUMBERS, SceneError, require_between, require_points, require_tuple

SPEED_M_S, SPEED_SPREAD_M_S = 1.29, 0.19
"""Walking speed of people who are alone: mean and standard deviation [m/s] (Moussaid et al. 2009,
"Experimental study of the behavioural mechanisms underlying self-organization in human crowds", Proceedings
of the Royal Society B 276, 2755-2762)."""


@dataclass(frozen=True, slots=True)
class Walk:
    """A walk from the person's position to every point in turn, around walls and furniture."""

    route: tuple[XY, ...]
    loop: bool = False
    """Whether the walk repeats; otherwise the person stays at the last point."""
    speed_m_s: float = SPEED_M_S
    pauses_s: tuple[float, ...] = ()
    """Pause at each point [s]; empty: none."""
    stops: bool = False
    """Whether the person stops for a robot that approaches them, and looks at it."""
    accompanied: bool = False
    """Whether the person agreed to be accompanied by the robot."""

    def __post_init__(self) -> None:
        require_points("walk", "route", self.route)
        require_between("walk", "speed_m_s", self.speed_m_s, 0.1, 3.0)
        truths = {name: (getattr(self, name), TRUTH) for name in ("loop", "stops", "accompanied")}
        require_kinds("walk", **truths)
        require_tuple("walk", "pauses_s", self.pauses_s, NUMBERS, "numbers")
        for pause in self.pauses_s:
            require_between("walk", "pauses_s", pause, 0.0, 36_000.0)
        if not self.route:
            raise _wrong("route", "at least one point to walk to", "none", "Add where the walk leads.")
        if self.pauses_s and len(self.pauses_s) != len(self.route):
            expected = f"a pause for every point of the route, {len(self.route)} in all"
            remedy = "Write as many pauses as points, 0 where the person walks on."
            raise _wrong("pauses_s", expected, f"{len(self.pauses_s)}", remedy)
        if self.loop and len(set(self.route)) < 2:
            got, remedy = f"{len(set(self.route))}", "Add a point, or leave out the loop."
            raise _wrong("route", "two different points to walk between", got, remedy)

    @property
    def stops_s(self) -> tuple[float, ...]:
        """The pause at every point [s]."""
        return self.pauses_s or (0.0,) * len(self.route)


def _wrong(field: str, expected: str, got: str, remedy: str) -> SceneError:
    return SceneError(entity="walk", field=field, expected=expected, got=got, remedy=remedy)
