"""Confounds: other differences between clips, which may also explain participants' answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from comity.answers.study_with_people import ConfoundAnswer
from comity.study.columns import FACT, PROVENANCE, WISH, ColumnDefinition, columns_of
from comity.study.episode_rows import episode_rows
from comity_sim2d.metrics.metric import OWN

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_sim2d import Frames

GAZE_DEG = 15.0
"""Maximum angle between the robot's front and the person at which it looks at them [deg] (our choice)."""
FIRST = (
    "episode_duration_s",
    "episode_path_length_m",
    "episode_mean_speed_m_s",
    "episode_max_speed_m_s",
    "gaze_share",
)
"""Confounds listed first."""
LEFT_OUT = frozenset({"person", *PROVENANCE} - {"episode_outcome"})
OF_CLIPS: Mapping[str, ColumnDefinition] = {
    "gaze_share": ColumnDefinition(
        "1", f"Share of the time in which the robot's front is within {GAZE_DEG:g} deg of the person.", OWN
    ),
    "said": ColumnDefinition("", "All that the robot said to the person.", OWN),
}
"""Confounds besides the columns of a study."""

ClipFacts = Mapping[tuple[str, str], float | str]
"""Measurements of a clip, by person and column."""


def clip_facts(episode: Episode, frames: Frames) -> ClipFacts:
    """A study's measurements of an episode, where the robot looked, and what it said."""
    found: dict[tuple[str, str], float | str] = {}
    for row in episode_rows(episode, None, filtered=None):
        person = str(row["person"])
        for column, value in row.items():
            if column not in LEFT_OUT and not column.startswith((FACT, WISH)):
                found["" if column.startswith("episode_") else person, column] = value
        found[person, "gaze_share"] = gaze_share(frames, episode.prepared.file.scenario.robot.name, person)
        said = [act.text for act in episode.acts if act.person == person and act.text]
        found[person, "said"] = " / ".join(said)
    return found


def gaze_share(frames: Frames, robot: str, person: str) -> float:
    """Share of frames, in [0, 1], in which the robot's front points at the person within `GAZE_DEG`."""
    here, there = frames.of(robot), frames.of(person)
    towards = np.arctan2(there[:, 1] - here[:, 1], there[:, 0] - here[:, 0])
    past = np.abs((here[:, 2] - towards + np.pi) % (2 * np.pi) - np.pi)
    return round(float(np.mean(past <= np.radians(GAZE_DEG))), 4)


def confounds_of(facts: Sequence[ClipFacts]) -> tuple[ConfoundAnswer, ...]:
    """All differences between clips: duration, path, speed and gaze first, then in the order of a study.

    Args:
        facts: Measurements of each clip.
    """
    places = dict.fromkeys(place for one in facts for place in one)
    columns = {**columns_of((), (column for _, column in places)), **OF_CLIPS}
    order = {column: i for i, column in enumerate(dict.fromkeys((*FIRST, *columns)))}
    found = [
        _confound(person, column, columns[column], tuple(one.get((person, column)) for one in facts))
        for person, column in places
    ]
    differing = [one for one in found if len(set(map(_rounded, one.values))) > 1]
    return tuple(sorted(differing, key=lambda one: (order[one.quantity], one.person)))


def _confound(
    person: str, column: str, definition: ColumnDefinition, values: tuple[float | str | None, ...]
) -> ConfoundAnswer:
    numbers = [one for one in values if isinstance(one, int | float)]
    return ConfoundAnswer(
        person=person,
        quantity=column,
        unit=definition.unit,
        values=values,
        difference=max(numbers) - min(numbers) if len(numbers) == len(values) else None,
        definition=definition.means,
    )


def _rounded(value: float | str | None) -> float | str | None:
    """Rounded to a thousandth of the unit; smaller differences are invisible."""
    return round(value, 3) if isinstance(value, float) else value
