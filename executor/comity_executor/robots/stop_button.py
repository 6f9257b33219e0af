"""The robot's latching emergency stop: effective at once, and ended only by a person."""

from __future__ import annotations

from collections.abc import Callable

from comity_executor.robots.raised import raised


class StopButton:
    """A stop that latches.

    Args:
        read: Returns why the robot must stand still. Only an explicit False means "not pressed"; None, any
            other value and an exception count as pressed.
    """

    def __init__(self, read: Callable[[], object]) -> None:
        self._read = read
        self._pressed: str | None = None
        self._latched: str | None = None

    def look(self) -> None:
        """Read the stop: once in every tick, before anything else."""
        try:
            said = self._read()
        except Exception as error:
            said = f"the emergency stop cannot be read: {raised(error)}"
        self._pressed = None if is_false(said) else _in_words(said)
        self._latched = self._pressed or self._latched

    @property
    def reason(self) -> str | None:
        """Why the robot stands still; None if it may move."""
        return self._latched

    def resume(self) -> bool:
        """Resume after a released stop, if it is still released; returns whether the robot may move."""
        self.look()
        if self._pressed is None:
            self._latched = None
        return self._latched is None

    def hold(self, reason: str | None) -> None:
        """Take over a stop that has not been resumed."""
        self._latched = self._latched or reason


def is_false(said: object) -> bool:
    """Whether a value is False, including numpy's False, which is not an instance of bool."""
    if type(said).__module__ == "numpy":
        return type(said).__name__ in ("bool", "bool_") and not said
    return said is False


def _in_words(said: object) -> str:
    if isinstance(said, str) and said:
        return said
    return f"the emergency stop says {said!r}, and only False is not pressed"
