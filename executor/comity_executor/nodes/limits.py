"""How patient an execution is, and how exact. All of these numbers are this project's own design choices."""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Times are simulated seconds; a value that contradicts another one cannot be built.

    Being docked has two bands around the pose (see `docking_band`). The tight one is entered, the loose one
    is left; the hold controller corrects all the while inside both. The loose one is asymmetric, as too near
    is worse than too far: it ends 25 cm closer than the pose, and 30 cm farther.
    """

    reach_timeout_s: float = 40.0
    """One attempt to reach a person."""
    reach_attempts: int = 2
    """Attempts, the first included; after the last one the visit is given up."""
    reach_pause_s: float = 1.0
    """After an attempt that an exception or a lost goal ended: that may be over before the next one."""
    accept_s: float = 0.5
    """So long a base may still speak of the goal before, or of none."""
    feedback_s: float = 1.0
    """A base that has said nothing of its goal for so long has lost it."""
    act_timeout_s: float = 10.0
    """One utterance or gesture, with all attempts at it."""
    act_pause_s: float = 1.0
    """An utterance or gesture that was broken off is tried again so much later."""
    blocked_s: float = 2.0
    """A motion that is blocked for so long has failed: a passer-by may stand in the way for a moment.

    Where it is a person who blocks it, they are asked to let the robot pass then.
    """
    passing_s: float = 6.0
    """After that, so long for them to make way; then the attempt has failed."""
    detour_m: float = 3.0
    """A person in the way is gone round at once where that is at most so much longer; else asked first."""
    unseen_s: float = 1.0
    """A docked robot that loses sight of the person believes the last reading for so long."""
    replans: int = 4
    """So many new plans in a row without anything being done; a tree that fails after them has failed."""
    replan_pause_s: float = 2.0
    """Before the second of them; before each further one twice as long as before the last."""
    patience_s: float = 60.0
    """A way that is known to be shut is waited for so long in all, until a person is served; no attempts."""
    cruise_speed_m_s: float = 0.8
    """On the way, until close to the pose; the approach itself has the person's own speed."""
    unverified_speed_m_s: float = 0.3
    """The most near a person whom the robot would not see from where it is to stand."""
    attend_s: float = 0.0
    """So long the robot watches how the person takes its coming; 0: it does not."""

    enter_distance_m: float = 0.01
    enter_bearing_deg: float = 3.0
    enter_facing_deg: float = 5.0
    rest_speed_m_s: float = 0.02
    """Below it the robot stands (the docking metrics use the same threshold)."""

    tolerance_m: float = 0.0
    """How far off its pose the base may come to rest: an execution takes what its robot states."""

    lost_distance_m: float = 0.05
    lost_bearing_deg: float = 10.0
    """While the robot turns it does not hold its place; farther off than this, it docks again."""

    leave_closer_m: float = 0.25
    leave_farther_m: float = 0.30
    leave_bearing_deg: float = 45.0
    leave_facing_deg: float = 45.0
    safety_floor_m: float = 0.30
    """No band reaches below it, whatever the pose (the rulebooks' safety clamp is the same)."""

    @classmethod
    def attentive(cls, attend_s: float) -> Limits:
        """The usual limits with time for a person's reaction, or without if it is 0.

        A person who turns away has said something and is not walked around: the band's bearing is wide.
        """
        return cls(attend_s=attend_s, leave_bearing_deg=100.0) if attend_s else cls()

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not (value > 0 or (field.name in _MAY_BE_NOTHING and value == 0)):
                raise ValueError(f"{field.name} must be positive, got {value}")
        for quantity in ("bearing_deg", "facing_deg"):
            self._check_wider(f"leave_{quantity}", f"enter_{quantity}")
        self._check_wider("leave_closer_m", "enter_distance_m")
        self._check_wider("leave_farther_m", "enter_distance_m")
        self._check_wider("lost_distance_m", "enter_distance_m")
        self._check_wider("lost_bearing_deg", "enter_bearing_deg")

    def _check_wider(self, outer: str, inner: str) -> None:
        if getattr(self, outer) <= getattr(self, inner):
            values = f"{getattr(self, outer)} <= {getattr(self, inner)}"
            raise ValueError(f"{outer} must exceed {inner}, or docking flickers: {values}")


_MAY_BE_NOTHING = frozenset({"attend_s", "tolerance_m", "replans", "patience_s"})
DEFAULT_LIMITS = Limits()
