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


HALL = """\
schema_version: 1
name: visit
place: {width_m: 8, height_m: 5}
robot: {at_m: [1, 2.5]}
people:
  anna: {profile: arab_woman, at_m: [6, 2.5], facing_deg: 180}
  marta: {at_m: [3.5, 0.6], facing_deg: 90}
goals: [{greet: anna}]
"""
"""Anna is visited across a room, and Marta stands beside the way."""
