"""Where a person sees the robot, and Hall's social space, as manoeuvres, margins and metrics have them."""

from __future__ import annotations

FACES_DEG, BEHIND_DEG = 60.0, 90.0
"""Bearings of the robot from where a person looks [deg]: up to `FACES_DEG` they face it; beyond `BEHIND_DEG`
it comes from behind (our choice)."""
SOCIAL_M, CLOSE_SOCIAL_M = 3.6, 2.1
"""Where social space and its close phase end, between surfaces [m], as HuNavSim counts it: 12 and 7 feet,
3.66 and 2.13 m, of Hall, The Hidden Dimension, 1966."""
