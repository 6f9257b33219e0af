"""The process of a watchdog: what it is told, what it makes of silence, and what cannot be."""

from __future__ import annotations

import pytest

from comity_executor import ActGoal, Watchdog, WatchdogError


@pytest.mark.parametrize(
    ("robot", "arguments", "reason"),
    [
        ("no_such_module:Robot", (), "ModuleNotFoundError"),
        ("comity_executor:NoSuchClass", (), "AttributeError"),
        ("comity_executor:ScriptedRobot", (), "TypeError"),
    ],
)
def test_a_robot_that_cannot_be_made_is_refused_with_the_reason(robot, arguments, reason) -> None:
    with pytest.raises(WatchdogError, match=reason):
        Watchdog(robot, *arguments)


def test_what_the_robot_says_and_raises_comes_through() -> None:
    with Watchdog("comity_executor:ScriptedRobot", {"johanna": 3.0}) as robot:
        assert robot.name == "robot"
        assert robot.capabilities.lease_s == 0.3
        assert robot.emergency() is False
        assert robot.read("johanna").distance_m == 3.0
        assert robot.read("nobody") is None
        act = robot.perform(ActGoal("say", "johanna", "Hello."))
        assert robot.performance(act).state == "running"
        with pytest.raises(WatchdogError, match="performance: IndexError"):
            robot.performance("act 9")
    with pytest.raises(WatchdogError, match="the watchdog's process is gone"):
        robot.emergency()


def test_calls_that_only_some_robots_have_come_through() -> None:
    with Watchdog("comity_executor:ScriptedRobot", {"johanna": 3.0}) as robot:
        assert robot.carried() is None
        assert not hasattr(robot, "localisation")
    with Watchdog("gliding:gliding") as robot:
        assert robot.localisation().x_m == 1.0
        assert {track.person for track in robot.tracks()} == {"host", "guest"}
        assert not hasattr(robot, "carried")


def test_how_far_its_gestures_reach_comes_through_where_the_robot_states_it() -> None:
    with Watchdog("gliding:reaching") as robot:
        assert robot.gesture_reach_m == {"wave": 0.45}
    with Watchdog("gliding:gliding") as robot:
        assert not hasattr(robot, "gesture_reach_m")
