"""A robot of the user's own, written for an earlier version, is refused before anything moves."""

from __future__ import annotations

import pytest

from comity_executor import Execution
from comity_executor.robots.robot import DockingPose
from comity_fis.errors import InputError
from tests.executor.conftest import Hall, Stander, infer, plan_for


class Earlier(Hall):
    """A hall whose robot knows nothing of speeds near people."""

    def navigate(self, person: str, pose: DockingPose, *, speed_m_s: float, detour_m: float = 1.0) -> None:
        super().navigate(person, pose, speed_m_s=speed_m_s, detour_m=detour_m)


class Wrapper(Hall):
    """A hall whose robot passes on whatever it is given."""

    def navigate(self, *args: object, **named: object) -> None:
        super().navigate(*args, **named)


def test_a_robot_whose_navigate_lacks_an_argument_is_refused_with_the_names_of_both() -> None:
    hall = Earlier({"ana": Stander(3.0, 0.0)})
    with pytest.raises(InputError) as refused:
        Execution(plan_for("ana"), hall, {"ana": infer()})
    assert "Earlier.navigate" in refused.value.expected
    assert refused.value.got == "one without near_m_s"


def test_a_robot_that_passes_all_arguments_on_is_taken() -> None:
    hall = Wrapper({"ana": Stander(3.0, 0.0)})
    execution = Execution(plan_for("ana"), hall, {"ana": infer()})
    while execution.tick() == "running" and hall.now_s() < 60.0:
        hall.step()
    assert execution.status == "success"
