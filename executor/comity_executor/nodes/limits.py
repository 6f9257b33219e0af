"""Timeouts, numbers of attempts and tolerances of an execution. All values are our own design choices."""

from __future__ import annotations

from dataclasses import dataclass, fields
from math import inf


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Times are simulated seconds; contradictory values are rejected.

    Docking has two bands around the pose (see `docking_band`): the tight one to enter, the loose one to
    leave; the controller corrects the pose inside both. The loose one is asymmetric, as too near is worse
    than too far: it ends 25 cm closer than the pose, and 30 cm farther.
    """

    reach_timeout_s: float = 40.0
    """Timeout of one attempt to reach a person [s]."""
    reach_attempts: int = 2
    """Number of attempts, including the first; after the last one the visit is given up."""
    reach_pause_s: float = 1.0
    """Pause after an attempt ended by an exception or a lost goal, which may be temporary [s]."""
    accept_s: float = 0.5
    """Time for which a base may still report the previous goal, or none [s]."""
    feedback_s: float = 1.0
    """Time without a report after which a base counts as having lost its goal [s]."""
    act_timeout_s: float = 10.0
    """Timeout of one utterance or gesture, with all attempts [s]."""
    act_pause_s: float = 1.0
    """Pause before an aborted utterance or gesture is retried [s]."""
    blocked_s: float = 2.0
    """Time after which a blocked motion has failed [s]: a passer-by may stand in the way for a moment.

    If a person blocks it, they are asked to make way at that time.
    """
    passing_s: float = 6.0
    """Time for them to make way after that [s]; then the attempt has failed."""
    detour_m: float = 3.0
    """Maximum additional length of a detour around a person [m]; if it is longer, the robot asks first."""
    unseen_s: float = 1.0
    """Time for which a docked robot that loses sight of the person relies on the last reading [s]."""
    replans: int = 4
    """Maximum number of new plans in a row without progress; after that, a failed tree has failed for
    good."""
    replan_pause_s: float = 2.0
    """Pause before the second of them [s], doubled before each further one."""
    patience_s: float = 60.0
    """Total time to wait for a path known to be shut, until a person is served [s]; it uses up no
    attempts."""
    ends_s: float = inf
    """Time at which the execution is stopped at the latest [s]: no wait is announced beyond it."""
    cruise_speed_m_s: float = 0.8
    """Travel speed until close to the pose [m/s]; the approach itself has the person's own speed."""
    unverified_speed_m_s: float = 0.3
    """Maximum speed near a person whom the robot would not see from its pose [m/s]."""
    attend_s: float = 0.0
    """Time for which the robot watches the reaction to its approach [s]; 0: not at all."""

    enter_distance_m: float = 0.01
    enter_bearing_deg: float = 3.0
    enter_facing_deg: float = 5.0
    rest_speed_m_s: float = 0.02
    """Speed below which the robot stands [m/s] (the docking metrics use the same threshold)."""

    tolerance_m: float = 0.0
    """Maximum distance from its pose at rest [m]: an execution takes the value that its robot states."""

    lost_distance_m: float = 0.05
    lost_bearing_deg: float = 10.0
    """Deviation of the bearing at which a turning robot docks again [deg]; it does not hold its position."""

    leave_closer_m: float = 0.25
    leave_farther_m: float = 0.30
    leave_bearing_deg: float = 45.0
    leave_facing_deg: float = 45.0
    safety_floor_m: float = 0.30
    """Lower limit of all bands, whatever the pose [m] (equal to the rulebooks' safety clamp)."""

    @classmethod
    def attentive(cls, attend_s: float) -> Limits:
        """The default limits with time for a person's reaction, or without if it is 0 [s].

        A person who turns away has sent a signal and is not walked around: the band's bearing is wide.
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
