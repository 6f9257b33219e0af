"""The robot's stop as it is obeyed: it takes effect at once, and only a person's word ends it."""

from __future__ import annotations

from collections.abc import Callable

from comity_executor.robots.raised import raised


class StopButton:
    """A stop that latches.

    Args:
        read: Says why the robot must stand still; only an explicit False is "not pressed". None, any other
            value and an exception are pressed.
    """

    def __init__(self, read: Callable[[], object]) -> None:
        self._read = read
        self._pressed: str | None = None
        self._latched: str | None = None

    def look(self) -> None:
        """Read it: once in every tick, before anything else."""
        try:
            said = self._read()
        except Exception as error:
            said = f"the emergency stop cannot be read: {raised(error)}"
        self._pressed = None if is_false(said) else _in_words(said)
        self._latched = self._pressed or self._latched

    @property
    def reason(self) -> str | None:
        """Why the robot stands still; None where it may go."""
        return self._latched

    def resume(self) -> bool:
        """Let the robot go on after a stop that was released, and is still; whether it may."""
        self.look()
        if self._pressed is None:
            self._latched = None
        return self._latched is None

    def hold(self, reason: str | None) -> None:
        """Take over a stop that has not been resumed."""
        self._latched = self._latched or reason


def is_false(said: object) -> bool:
    """Whether an answer is the word False, numpy's included, which is no instance of bool."""
    if type(said).__module__ == "numpy":
        return type(said).__name__ in ("bool", "bool_") and not said
    return said is False


def _in_words(said: object) -> str:
    if isinstance(said, str) and said:
        return said
    return f"the emergency stop says {said!r}, and only False is not pressed"
