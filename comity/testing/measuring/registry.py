"""What `comity test` compares between profiles: name, unit, definition, source.

These need the events of an episode, or what becomes of its people; those that frames alone give stand in
`comity_sim2d.EPISODE` and `VISIT`. `docs/reference/metrics.md` has all of them.
"""

from __future__ import annotations

from collections.abc import Mapping

from comity_sim2d import Metric
from comity_sim2d.metrics.metric import by_name

TESTED: Mapping[str, Metric] = by_name(
    Metric(
        "served",
        "1",
        "People greeted, and people that the plan skipped at the scenario's price. As a mean: the share of "
        "the people to visit who did not decline.",
    ),
    Metric("time_s", "s", "From the start to when the last node of the tree ended."),
    Metric(
        "distance_error_m",
        "m",
        "Size of the difference between the docking distance (surface to surface, as the robot docked "
        "last) and the target at the end of the episode, for each person at whom it docked; `--fairness` "
        "takes the largest of an episode.",
    ),
    Metric("way_s", "s", "Time on the way: navigation to people (`Navigate_to_user`), over all visits."),
    Metric(
        "coming_near_s",
        "s",
        "Time of coming near: docking and facing (`Dock_to_user`, `Face_user`), over all visits.",
    ),
    Metric(
        "greeting_s",
        "s",
        "Time of the greeting: words and gestures, over all visits; those at the same time count once.",
    ),
    Metric("attending_s", "s", "Time of attending to people (`Attend_to`), over all visits."),
    Metric("intrusion_s", "s", "The episode's `longest_intrusion_s`."),
    Metric(
        "detour_m",
        "m",
        "Path length of the robot's centre beyond the straight lines from its start through the places where "
        "it docked.",
    ),
)
"""Of an episode; `comity test` shows means."""
