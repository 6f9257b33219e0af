"""A room for scenario tests: two people to greet, and one who stands by."""

from __future__ import annotations

from collections.abc import Callable

ROOM = """\
schema_version: 1
name: two-in-a-room
place: {width_m: 8.0, height_m: 6.0}
robot: {at_m: [1.0, 1.0]}
people:
  host: {profile: arab_woman, at_m: [2.6, 4.8], facing_deg: -90}
  guest: {profile: german_man, at_m: [6.8, 1.2], facing_deg: 180}
  sam: {profile: german_man, at_m: [4.6, 2.2], facing_deg: 0}
goals:
  - greet: host
  - greet: guest
"""

FIRST_LINE = ROOM.count("\n") + 2
"""Of the sentences."""


def scenario(*sentences: str, more: str = "", room: Callable[[str], str] = str) -> str:
    """The room with what is expected there."""
    expect = "".join(f"  - {sentence}\n" for sentence in sentences)
    return room(ROOM) + (f"expect:\n{expect}" if sentences else "") + more
