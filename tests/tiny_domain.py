"""A classical domain of one action, as a user's own."""

from __future__ import annotations

from pathlib import Path

DOMAIN = "(define (domain d) (:predicates (p) (q)) (:action a :parameters () :precondition (p) :effect (q)))"
PROBLEM = "(define (problem x) (:domain d) (:init (p)) (:goal (q)))"
PLAN = ("plan", "--domain", "d.pddl", "--problem", "p.pddl")
"""The command that plans it."""


def write_tiny_domain(folder: Path) -> None:
    """As `d.pddl` and `p.pddl`."""
    (folder / "d.pddl").write_text(DOMAIN, encoding="utf-8")
    (folder / "p.pddl").write_text(PROBLEM, encoding="utf-8")
