"""The visit domain is one thing: as a unified-planning problem, as a commented file, and in short."""

from __future__ import annotations

import re
from importlib.resources import files

import pytest
from unified_planning.environment import get_environment
from unified_planning.io import PDDLReader

from comity_domain import problem_of, steps
from comity_domain.choices.options import options
from comity_domain.classical.initial_state import goals, initial_state
from comity_domain.classical.naming import RESERVED
from comity_domain.classical.pddl import domain_pddl
from comity_domain.classical.visit_domain import empty_problem
from comity_domain.plans import actions
from comity_domain.plans.actions import TASKS

NOBODY = """(define (problem any) (:domain {name})
    (:init (= (total-cost) 0)) (:goal (and)) (:metric minimize (total-cost)))"""


def read(text: str, name: str):
    # unified-planning 1.3 reads costs in its global environment only
    return PDDLReader(get_environment()).parse_problem_string(text, NOBODY.format(name=name))


@pytest.fixture(scope="module")
def in_file():
    return read(domain_pddl(), "visit-domain")


@pytest.fixture(scope="module")
def stated():
    return empty_problem("any")


def above(kind) -> tuple[str, ...]:
    """A type's name, and those of the types above it."""
    return (kind.name, *(above(kind.father) if kind.father else ()))


def fluents(problem):
    """By name, the types of the arguments and whether it is a number."""
    return {
        one.name: (tuple(above(argument.type) for argument in one.signature), one.type.is_bool_type())
        for one in problem.fluents
        if one.name != "total-cost"
    }


def plain(condition) -> object:
    """A condition in which the order of what is joined does not matter."""
    if condition.is_and() or condition.is_or():
        return ("or" if condition.is_or() else "and", frozenset(map(plain, condition.args)))
    if condition.is_not():
        return ("not", plain(condition.args[0]))
    return str(condition)


def joined(conditions) -> frozenset:
    """What is joined by `and`, wherever the brackets stand."""
    found = set()
    for one in conditions:
        found |= joined(one.args) if one.is_and() else {plain(one)}
    return frozenset(found)


def effects(action) -> frozenset:
    """What is changed, to what, under which conditions, for all of what."""
    return frozenset(
        (
            re.sub(r"\b(n|t|v|c)\b", "_", str(one.fluent)) if one.is_forall() else str(one.fluent),
            str(one.value),
            frozenset(re.sub(r"\b(n|t|v|c)\b", "_", str(part)) for part in joined([one.condition])),
            tuple(variable.type.name for variable in one.forall),
        )
        for one in action.effects
    )


def meaning(problem):
    """By action, in small letters: its parameters, conditions, effects and cost."""
    (metric,) = problem.quality_metrics
    return {
        action.name.lower(): (
            [(one.name, above(one.type)) for one in action.parameters],
            joined(action.preconditions),
            effects(action),
            str(metric.get_action_cost(action) or 0),
        )
        for action in problem.actions
    }


def test_the_file_has_the_types_fluents_and_actions_of_the_problem(in_file, stated):
    assert {above(kind) for kind in in_file.user_types} == {above(kind) for kind in stated.user_types}
    assert fluents(in_file) == fluents(stated)
    in_words, in_python = meaning(in_file), meaning(stated)
    assert in_words.keys() == in_python.keys()
    for action, said in in_words.items():
        assert said == in_python[action], action


def test_reaching_and_greeting_come_first(stated):
    assert [action.name for action in stated.actions[:2]] == ["Reach_user", "Greet_person"]


def test_no_object_may_be_called_like_a_word_of_the_domain(stated):
    """Types, fluents and actions are all reserved, and the list names no others of the kind."""
    words = {
        *(t.name for t in stated.user_types),
        *(f.name for f in stated.fluents),
        *(a.name.lower() for a in stated.actions),
    }
    syntax = set(re.findall(r"[a-z]+", "and or not imply exists forall when either object number visit"))
    syntax |= {"start", "end", "over", "all"}
    syntax |= set(re.findall(r"[a-z]+", "define domain problem increase decrease assign minimize maximize"))
    assert words == RESERVED - syntax


def test_every_action_is_a_step_that_plans_have(stated):
    """And the other way round."""
    words = [name for name, value in vars(actions).items() if name.isupper() and isinstance(value, str)]
    named = {getattr(steps, name) for name in words if hasattr(steps, name)}
    assert {action.name for action in stated.actions} == named | {*TASKS, actions.SKIP}


@pytest.mark.parametrize("seed", range(4))
def test_a_problem_holds_every_fact_and_goal(agenda_request, seed):
    request = agenda_request(4, seed)
    problem, choices = problem_of(request), options(request)
    assert len(problem.goals) == len(list(goals(choices)))
    facts = list(initial_state(choices))
    assert len(problem.explicit_initial_values) == len({(one.fluent, one.arguments) for one in facts})
    assert all(one.value is True or (type(one.value) is int and one.value >= 0) for one in facts)


def forms(text: str) -> list:
    """Nested lists of words."""
    stack: list[list] = [[]]
    for word in re.findall(r"[()]|[^\s()]+", re.sub(r";.*", "", text)):
        if word == ")":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack.append([]) if word == "(" else stack[-1].append(word)
    return stack[0][0]


def inside(form, head: str):
    """The parts of a form that begin with a word, however deep."""
    for part in form:
        if isinstance(part, list):
            yield from ([part] if part[:1] == [head] else [])
            yield from inside(part, head)


def test_no_effect_on_a_condition_holds_another_or_one_for_all():
    """PDDL 2.1 has none inside, and unified-planning's reader forgets the outer condition of such."""
    effects_ = [effect for _, _, effect in inside(forms(domain_pddl()), "when")]
    literals = [part for one in effects_ for part in (one[1:] if one[0] == "and" else [one])]
    heads = {(part[1] if part[0] == "not" else part)[0] for part in literals}
    assert heads
    assert not heads & {"and", "when", "forall"}


def core_pddl() -> str:
    return files("comity_domain").joinpath("core.pddl").read_text(encoding="ascii")


def test_the_core_is_a_part_of_the_domain(stated):
    """Its actions need and do no more, with the same words; what it leaves out are hands and turns."""
    core, whole = meaning(read(core_pddl(), "core-domain")), meaning(stated)
    assert set(core) == {"reach_user", "greet_person"}
    parameters, needs, does, cost = core["reach_user"]
    assert set(map(str, parameters)) < set(map(str, whole["reach_user"][0]))
    assert cost == whole["reach_user"][3]
    assert does < whole["reach_user"][2]
    assert needs - whole["reach_user"][1] == {("not", "greeted(u)")}  # or the visit was begun before
    assert core["greet_person"][1] < whole["greet_person"][1]
