"""Metrics of an episode: how the robot moved, how near it came to people, how it stopped before them."""

from comity_sim2d.metrics.episode import Metrics, intrusion_of, measure
from comity_sim2d.metrics.intrusion import own_distances_m
from comity_sim2d.metrics.known import Contacts, Known
from comity_sim2d.metrics.metric import Metric, without_unit
from comity_sim2d.metrics.motion import Span, path_length_m, speeds_m_s
from comity_sim2d.metrics.proximity import clearances_m, seconds_to_collision
from comity_sim2d.metrics.registry import (
    EPISODE,
    VISIT,
    by_short_name,
    of_episode,
    of_person,
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
