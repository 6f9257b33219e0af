"""Distances and directions beside a person that plans and the world have in common."""

from __future__ import annotations

PERSON_MARGIN_M = 0.30
"""So far the robot stays from people, surface to surface [m]: the design's safety floor (our choice)."""
COMFORT_M = 0.45
"""The distance of people whose own is not known [m]: the smallest one of Bruno et al. 2017."""
FRONT_DEG, WIDEST_DEG = 22.5, 90.0
"""Bearings [deg]: the front of a person is [-22.5, 22.5], a quarter of the half circle (our choice). Nobody
is approached from beyond `WIDEST_DEG`, from behind their shoulders, unless they asked for it."""
FACES_DEG, BEHIND_DEG = 60.0, 90.0
"""Bearings of the robot from where a person looks [deg]: up to `FACES_DEG` they face it and see it come;
beyond `BEHIND_DEG` it comes from behind (our choice)."""
SOCIAL_M, CLOSE_SOCIAL_M = 3.6, 2.1
"""Where social space and its close phase end, between surfaces [m], as HuNavSim counts it: 12 and 7 feet,
3.66 and 2.13 m, of Hall, The Hidden Dimension, 1966."""
