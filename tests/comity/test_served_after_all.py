"""What the picture and the figures of a run say of each person."""

from __future__ import annotations

import pytest
from places import FLAT
from saved import saved

import comity
from comity.replay.pictures import rings_of


def test_somebody_who_is_let_out_and_served_is_shown_once_and_as_served(here) -> None:
    """The owner is behind a shut door at first; the robot greets them once it was opened."""
    rings = rings_of(saved("comity-bench-1/door-opens", here / "run"))
    assert len({ring.person for ring in rings}) == len(rings)
    owner = next(ring for ring in rings if ring.person == "owner")
    assert owner.reached_m == pytest.approx(owner.wanted_m, abs=0.01)
    assert "could not be served" not in owner.label


def test_somebody_whom_only_a_later_plan_serves_has_figures_of_the_stop() -> None:
    """Their visit is a visit: standing before them is no intrusion."""
    metrics = comity.run("comity-bench-1/door-opens").metrics
    assert metrics.stopping["owner"].stop_distance_error_m == pytest.approx(0.0, abs=0.01)
    assert metrics.compliance_share["owner"] == 1.0


def test_somebody_who_stays_out_of_reach_is_shown_as_not_served(here) -> None:
    shut = FLAT.replace("place: {map: apartment}", "place: {map: apartment, doors: {study: closed}}")
    path = here / "shut.scenario.yaml"
    path.write_text(f"{shut}goals: [{{greet: guest}}]\nlimits: {{patience_s: 0}}\n")
    (ring,) = rings_of(saved(path, here / "run"))
    assert ring.reached_m is None
    assert "could not be served" in ring.label
