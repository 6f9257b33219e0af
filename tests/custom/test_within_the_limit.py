"""Whatever a domain holds, `comity plan --domain` ends with an answer or a refusal in its time."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from downward import needs_fast_downward
from hypothesis import given
from hypothesis import strategies as st

from comity_domain.custom import bind, custom_pddl, read_custom
from comity_domain.custom.solving.stated import stated

PATIENCE_S = 5.0


def corridor(length: int) -> tuple[str, str]:
    """As many places in a row, of which the tenth is wanted."""
    places = " ".join(f"c{i}" for i in range(length))
    joined = " ".join(f"(next c{i} c{i + 1})" for i in range(length - 1))
    return (
        """(define (domain corridor) (:requirements :typing) (:types place)
  (:predicates (at ?a - place) (next ?a ?b - place))
  (:action go :parameters (?a ?b - place) :precondition (and (at ?a) (next ?a ?b))
    :effect (and (not (at ?a)) (at ?b))))""",
        f"(define (problem p) (:domain corridor) (:objects {places} - place)"
        f" (:init (at c0) {joined}) (:goal (at c9)))",
    )


def combinations(objects: int) -> tuple[str, str]:
    """One action over five objects, of which any will do: so many to the fifth ground actions."""
    names = " ".join(f"o{i}" for i in range(objects))
    facts = " ".join(f"(p o{i})" for i in range(objects))
    return (
        """(define (domain five) (:requirements :typing) (:types o)
  (:predicates (p ?x - o) (q ?a ?b ?c ?d ?e - o))
  (:action link :parameters (?a ?b ?c ?d ?e - o)
    :precondition (and (p ?a) (p ?b) (p ?c) (p ?d) (p ?e)) :effect (q ?a ?b ?c ?d ?e)))""",
        f"(define (problem p) (:domain five) (:objects {names} - o)"
        f" (:init {facts}) (:goal (q o0 o1 o2 o3 o4)))",
    )


def written(texts: tuple[str, str], folder: Path) -> tuple[Path, Path]:
    (folder / "d.pddl").write_text(texts[0])
    (folder / "p.pddl").write_text(texts[1])
    return folder / "d.pddl", folder / "p.pddl"


def test_writing_enumerates_no_atoms_that_are_not_stated(tmp_path):
    """unified-planning's own writer would ask for 40^5 of them."""
    bound = bind(read_custom(*written(combinations(40), tmp_path)))
    start = time.process_time()
    text = custom_pddl(bound).problem
    assert text.count("(p o") == 40
    assert time.process_time() - start < 2.0


@given(st.integers(2, 6))
def test_what_is_written_is_what_unified_planning_writes(tmp_path_factory, length):
    """Law: to leave out what is not stated changes no word."""
    from unified_planning.io import PDDLWriter

    texts = corridor(length)[0], corridor(length)[1].replace("(at c9)", f"(at c{length - 1})")
    problem = bind(read_custom(*written(texts, tmp_path_factory.mktemp("corridor")))).problem
    ours = PDDLWriter(stated(problem))
    domain, written_problem = ours.get_domain(), ours.get_problem()
    theirs = PDDLWriter(problem)
    assert domain == theirs.get_domain()
    assert sorted(written_problem.split()) == sorted(theirs.get_problem().split())


def test_a_value_by_default_is_written():
    from unified_planning.io import PDDLWriter
    from unified_planning.shortcuts import BoolType, Fluent, Object, Problem, UserType

    place = UserType("place")
    problem = Problem("p")
    problem.add_fluent(Fluent("lit", BoolType(), where=place), default_initial_value=True)
    problem.add_object(Object("c0", place))
    assert "(lit c0)" in PDDLWriter(stated(problem)).get_problem()


@needs_fast_downward
@pytest.mark.parametrize("limit_s", [1, 3])
def test_a_domain_with_too_many_combinations_is_refused_in_time(comity, here, limit_s):
    written(combinations(40), here)
    start = time.monotonic()
    said = comity("plan", "--domain", "d.pddl", "--problem", "p.pddl", "--limit", limit_s)
    assert time.monotonic() - start < limit_s + PATIENCE_S
    assert said.code == 1
    assert f"it is {limit_s:g} now" in said.err


def test_files_that_take_too_long_to_read_are_refused_in_time(comity, here):
    written(corridor(2900), here)
    start = time.monotonic()
    said = comity("plan", "--domain", "d.pddl", "--problem", "p.pddl", "--limit", "0.1")
    assert time.monotonic() - start < 0.1 + PATIENCE_S
    assert said.code == 1
    assert "no plan was found within 0.1 s" in said.err
    assert "Traceback" not in said.err
