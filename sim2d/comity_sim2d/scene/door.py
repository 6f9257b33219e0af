"""A door: a gap in a wall that can be shut."""

from __future__ import annotations

from dataclasses import dataclass

from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.pose import XY
from comity_sim2d.scene_error import SceneError, require_between, require_one_of, require_points, require_text

KINDS = ("hinged", "sliding", "opening")
"""An opening has no leaf: it is a door that is never shut. The others differ only in how they are drawn."""
LEAF_M = 0.05
"""The thickness of a door's leaf (our choice)."""


@dataclass(frozen=True, slots=True)
class Door:
    """A straight gap in a wall. Open, it is passable and its leaf takes no room; shut, it is a wall."""

    name: str
    start: XY
    """One side of the gap; a hinged door hangs here [m]."""
    end: XY
    """The other side [m]."""
    is_open: bool = True
    kind: str = "hinged"
    """One of `KINDS`."""
    thickness_m: float = LEAF_M

    def __post_init__(self) -> None:
        require_text("door", "name", self.name)
        require_points(self.name, "start", (self.start,))
        require_points(self.name, "end", (self.end,))
        require_between(self.name, "thickness_m", self.thickness_m, 0.001, 10.0)
        require_one_of(self.name, "kind", self.kind, KINDS)
        require_kinds(self.name, is_open=(self.is_open, TRUTH))
        if self.start == self.end:
            raise self._refusal("width_m", "a door with a width", "one without")
        if self.kind == "opening" and not self.is_open:
            raise self._refusal("is_open", "an opening to be open", "one that is shut")

    @property
    def shut_name(self) -> str:
        """Name of the shut door in messages."""
        return f"the closed door {self.name!r}"

    def _refusal(self, field: str, expected: str, got: str) -> SceneError:
        remedy = "Change it, or remove the door."
        return SceneError(entity=self.name, field=field, expected=expected, got=got, remedy=remedy)
