"""Whether a picture or an animation can be drawn, found before any of it is."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from comity_sim2d.scene_error import SceneError, require_whole

if TYPE_CHECKING:
    from comity_sim2d.ring import Ring
    from comity_sim2d.scene import Scene

WIDTH_PX = (100, 10_000)
"""Of a page: less is illegible, more takes gigabytes (our choice)."""


def check_drawing(
    what: str, path: str | Path, suffix: str, *, scene: Scene, rings: Iterable[Ring], width_px: int
) -> None:
    """Refuse a file of another format, a width that no page has, and visits to nobody.

    Args:
        what: What is drawn, for the message.
        path: Where to write.
        suffix: How its name must end, such as `.png`; in capitals, too.
        scene: Who is there.
        rings: The visits.
        width_px: Of the page, in `WIDTH_PX`.

    Raises:
        SceneError: about the file's name or the width.
        ValueError: for a visit to somebody who is not in the scene.
    """
    if Path(path).suffix.lower() != suffix:
        raise SceneError(
            entity=what,
            field="path",
            expected=f"a path that ends with {suffix}",
            got=repr(str(path)),
            remedy="Name it so, and convert it afterwards.",
        )
    require_whole(what, "width_px", width_px, *WIDTH_PX)
    for ring in rings:
        scene.person(ring.person)
