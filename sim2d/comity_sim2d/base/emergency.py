"""The emergency stop: a button that cuts the motors of the base, whatever its commands."""

from __future__ import annotations


class EmergencyStop:
    """An emergency stop, pressed for one or more reasons until all of them are released."""

    def __init__(self) -> None:
        self._reasons: list[str] = []
        self.was_pressed = False
        """Whether a person has ever pressed it, not only a contact."""

    @property
    def reason(self) -> str | None:
        """Why it is pressed, in words; None while it is not."""
        return "; ".join(dict.fromkeys(self._reasons)) if self._reasons else None

    def press(self, reason: str = "the emergency stop is pressed", *, contact: bool = False) -> None:
        """Stop the robot at once; it stays stopped until each press is released, repeated reasons included.

        Args:
            reason: Why, in words.
            contact: Whether the cause is a contact and not a person.
        """
        self._reasons.append(reason)
        self.was_pressed = self.was_pressed or not contact

    def release(self, reason: str = "the emergency stop is pressed") -> None:
        """Release one press of this reason; no effect if there is none."""
        if reason in self._reasons:
            self._reasons.remove(reason)
