"""What is wrong with the robot, or around it, by the part that it is wrong with; the effects follow from it.

A robot with trouble at its `BASE` stands where it is, whatever the wheels are told. One with trouble with its
`VOICE` falls silent in mid-word. One with trouble with its `SENSORS` sees nobody, and stands until it does:
it could not see whom it drives into. Trouble on the `WAY`, or with a person, changes nothing by itself: it is
kept so that the robot can say what is behind what it meets.
"""

from __future__ import annotations

BASE, VOICE, SENSORS, WAY = "base", "voice", "sensors", "way"


class Troubles:
    """Those of now; a part may have several, and the same one twice."""

    def __init__(self) -> None:
        self._texts: dict[str, list[str]] = {}

    def begin(self, part: str, text: str) -> None:
        """Something is wrong from now on.

        Args:
            part: One of the parts above, or a person's name.
            text: What, in words.
        """
        self._texts.setdefault(part, []).append(text)

    def end(self, part: str, text: str) -> None:
        """It is over.

        Raises:
            ValueError: if it did not begin.
        """
        self._texts.get(part, []).remove(text)

    def of(self, part: str) -> str | None:
        """What is wrong with a part, in words; None where nothing is."""
        texts = self._texts.get(part)
        return "; ".join(dict.fromkeys(texts)) if texts else None
