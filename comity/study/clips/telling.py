"""Text output about clips."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comity.answers.study_with_people import StudyClipsAnswer
from comity.report.text import number, table, unbroken, words
from comity.study.clips.film import INSTALL
from comity.study.clips.making import CONFOUNDS, KEY, PAGES

if TYPE_CHECKING:
    from rich.console import RenderableType

SHOWN = 12
"""Maximum number of confounds on the terminal; the file has all."""


def clips_text(answer: StudyClipsAnswer) -> Iterator[RenderableType]:
    """What was made, as text; the values are only in the key."""
    fast = "" if answer.speed == 1 else f", played {answer.speed:g} times as fast"
    yield f"{answer.scenario} with {answer.parameter} changed: {len(answer.clips)} clips{fast}"
    yield table([(one.clip, one.outcome, f"{one.length_s:.1f} s") for one in answer.clips])
    if not answer.confounds:
        yield "  Nothing that was measured differs: the clips may look the same"
    else:
        yield "  What differs as well, and may be why people answer as they do:"
        rows = [
            (words(one.quantity), one.person, *(number(value, one.unit or None) for value in one.values))
            for one in answer.confounds[:SHOWN]
        ]
        yield table(rows, head=("quantity", "person", *(one.clip for one in answer.clips)))
    if (more := len(answer.confounds) - SHOWN) > 0:
        yield f"  {more} more in {CONFOUNDS}"
    if not any(file.endswith(".mp4") for file in answer.files):
        yield f"  No MP4: ffmpeg was not found. Install it ({INSTALL}) and film again"
    yield unbroken(f"Clips  {answer.folder}")
    yield f"  {KEY} says which is which, and {PAGES} show all values: keep both from participants"
