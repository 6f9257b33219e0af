"""The process of a watchdog: it holds the robot, does what it is told, and stops the base on silence.

It is `python -m comity_executor.live.watched ADDRESS`, with the key of the connection on standard input.
"""

from __future__ import annotations

import signal
import sys
import threading
from dataclasses import fields
from importlib import import_module
from math import inf
from multiprocessing.connection import Client, Connection
from typing import Any

from comity_executor.live.guard import Guard
from comity_executor.live.messages import Begin, Call, CallResult, Failed, Ready
from comity_executor.robots.capabilities import CapabilityValues
from comity_executor.robots.raised import raised
from comity_executor.robots.robot import Robot

GUARDED = ("go", "renew", "motion", "perform")
"""Calls that the watchdog has to know of; all others go to the robot."""
OPTIONAL = ("carried", "trouble", "trouble_with", "localisation", "tracks", "floor_is_free")
"""Calls that only some robots have."""


def serve(connection: Connection[Any, Any]) -> None:
    """Make the robot, and do what is asked until nobody is there to ask."""
    begin: Begin = connection.recv()
    sys.path[:] = begin.path
    try:
        module, _, name = begin.robot.partition(":")
        robot: Robot = getattr(import_module(module), name)(*begin.arguments)
        can: dict[str, Any] = {
            field.name: getattr(robot.capabilities, field.name, inf) for field in fields(CapabilityValues)
        }
        can["reduced_margin"] = getattr(robot.capabilities, "reduced_margin", None)
        more = tuple(name for name in OPTIONAL if hasattr(robot, name))
        reach_m = getattr(robot, "gesture_reach_m", None)
        connection.send(Ready(getattr(robot, "name", "robot"), CapabilityValues(**can), more, reach_m))
    except Exception as error:
        connection.send(Failed(0, raised(error)))
        return
    guard = Guard(robot, begin.lease_s)
    threading.Thread(target=guard.watch, name="watchdog", daemon=True).start()
    try:
        while True:
            call: Call = connection.recv()
            connection.send(_answer(call, guard, robot))
    except (EOFError, OSError):
        pass  # Comity is gone
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        guard.stop_for_good()


def _answer(call: Call, guard: Guard, robot: Robot) -> CallResult | Failed:
    owner = guard if call.name in GUARDED else robot
    if call.name == "heard" and not hasattr(robot, "heard"):
        return CallResult(call.call, ())  # it has no ears
    try:
        return CallResult(call.call, getattr(owner, call.name)(*call.arguments, **call.named))
    except Exception as error:
        return Failed(call.call, raised(error))


def main() -> None:
    """Connect to Comity, and serve it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    key = bytes.fromhex(sys.stdin.readline().strip())
    with Client(sys.argv[1], authkey=key) as connection:
        serve(connection)


if __name__ == "__main__":
    main()
