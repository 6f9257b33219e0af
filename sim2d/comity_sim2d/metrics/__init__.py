"""Metrics of an episode: how the robot moved, how near it came to people, how it stopped before them."""

from comity_sim2d.metrics.episode import Contacts, Known, Metrics, intrusion_of, measure
from comity_sim2d.metrics.intrusion import own_distances_m
from comity_sim2d.metrics.motion import Span, Spread, path_length_m, speeds_m_s
from comity_sim2d.metrics.proximity import clearances_m, seconds_to_collision
from comity_sim2d.metrics.registry import (
    EPISODE,
    VISIT,
    Metric,
    by_short_name,
    of_episode,
    of_person,
    without_unit,
)
from comity_sim2d.metrics.stopping import Stopping, TargetStop, stopping

__all__ = [
    "EPISODE",
    "VISIT",
    "Contacts",
    "Known",
    "Metric",
    "Metrics",
    "Span",
    "Spread",
    "Stopping",
    "TargetStop",
    "by_short_name",
    "clearances_m",
    "intrusion_of",
    "measure",
    "of_episode",
    "of_person",
    "own_distances_m",
    "path_length_m",
    "seconds_to_collision",
    "speeds_m_s",
    "stopping",
    "without_unit",
]
