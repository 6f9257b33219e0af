"""How far conditions hold: the same laws for every person and for columns of them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis.inference import columns
from comity_fis.rules import antecedent
from comity_fis.rules.antecedent import MIN_MAX, hedged
from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.rule import And, Hedged, Is, Not, Or

NAMES = ["a", "b", "c"]
statements = st.builds(Is, st.sampled_from(NAMES), st.just("t"))
conditions = st.recursive(
    statements | st.builds(Hedged, st.sampled_from(sorted(HEDGES)), statements),
    lambda inner: (
        st.builds(Not, inner)
        | st.builds(And, st.lists(inner, min_size=2, max_size=3).map(tuple))
        | st.builds(Or, st.lists(inner, min_size=2, max_size=3).map(tuple))
    ),
    max_leaves=8,
)
degrees = st.fixed_dictionaries({name: st.floats(0, 1) for name in NAMES})


def strength(condition, known):
    """As an inference has it; a name that is not in `known` was not disclosed."""

    def degree(literal):
        return hedged(known[literal.name], literal) if literal.name in known else 1.0

    return antecedent.strength(condition, degree, MIN_MAX)


def defined(condition, known):
    """By the definition: the tree as it stands."""
    match condition:
        case Is(name):
            return known[name]
        case Hedged(hedge, part):
            return known[part.name] ** HEDGES[hedge]
        case Not(part):
            return 1 - defined(part, known)
        case And(parts):
            return min(defined(part, known) for part in parts)
        case Or(parts):
            return max(defined(part, known) for part in parts)


@given(conditions, degrees)
def test_a_condition_means_what_its_text_says(condition, known):
    assert strength(condition, known) == pytest.approx(defined(condition, known))


@given(conditions, degrees)
def test_not_is_the_complement_where_all_is_known(condition, known):
    assert strength(Not(condition), known) == pytest.approx(1 - strength(condition, known))


@given(conditions)
def test_of_a_person_of_whom_nothing_is_known_everything_and_its_opposite_holds(condition):
    assert strength(condition, {}) == strength(Not(condition), {}) == 1


@given(conditions, degrees, st.sampled_from(NAMES))
def test_hiding_a_value_never_makes_a_rule_weaker(condition, known, hidden):
    rest = {name: degree for name, degree in known.items() if name != hidden}
    assert strength(condition, rest) >= strength(condition, known)


@given(conditions, st.lists(degrees, min_size=1, max_size=4))
def test_a_column_of_people_is_each_of_them(condition, people):
    def degrees(literal):
        return hedged(np.array([person[literal.name] for person in people]), literal)

    together = antecedent.strength(condition, degrees, columns.MIN_MAX)
    assert together.tolist() == pytest.approx([strength(condition, person) for person in people], abs=1e-15)


@given(st.floats(0, 1))
def test_very_sharpens_and_more_or_less_softens(degree):
    known = {"a": degree}
    sharp, soft = (strength(Hedged(hedge, Is("a", "t")), known) for hedge in ("very", "more or less"))
    assert strength(Hedged("extremely", Is("a", "t")), known) <= sharp <= degree <= soft
    assert sharp == pytest.approx(degree**2)
    assert soft == pytest.approx(degree**0.5)
