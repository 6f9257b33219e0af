"""The emergency stop: a button that cuts the motors of the base, whatever the robot was told to do."""

from __future__ import annotations


class EmergencyStop:
    """Pressed, for one or more reasons, until all of them are released."""

    def __init__(self) -> None:
        self._reasons: list[str] = []
        self.was_pressed = False
        """Whether a person has pressed it so far, and not a contact alone."""

    @property
    def reason(self) -> str | None:
        """Why it is pressed, in words; None while it is not."""
        return "; ".join(dict.fromkeys(self._reasons)) if self._reasons else None

    def press(self, reason: str = "the emergency stop is pressed", *, contact: bool = False) -> None:
        """Stop the robot at once; it stays stopped until every press is released, also of the same reason.

        Args:
            reason: Why, in words.
            contact: Whether nobody presses it, and the robot touched something.
        """
        self._reasons.append(reason)
        self.was_pressed = self.was_pressed or not contact

    def release(self, reason: str = "the emergency stop is pressed") -> None:
        """Let it go on, unless something else holds it; nothing happens if this did not."""
        if reason in self._reasons:
            self._reasons.remove(reason)
