"""Places that tests and studies share: how a scenario begins; more people and the goals follow."""

from __future__ import annotations

FLAT = """\
schema_version: 1
name: flat
place: {map: apartment}
robot: {at: front door}
people:
  guest: {profile: arab_man, at_m: [7.6, 5.6], facing_deg: -150}
"""
"""The guest is in the study, behind a door."""
