"""Whatever is wrong with PDDL ends with its file, its line and a remedy; what can be read is read."""

from __future__ import annotations

import random
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_domain.custom import bind, plan_custom, read_custom
from comity_domain.custom.reading.text import MAX_DEPTH, parsed
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.custom.solving.swap import row_of, works
from comity_fis import InputError

DOMAIN = """(define (domain rooms)
  (:requirements :strips :typing :action-costs)
  (:types place thing - object box - thing)
  (:constants hall - place)
  (:predicates (at ?p - place) (in ?b - thing ?p - place) (held ?b - thing))
  (:functions (way ?a ?b - place) (total-cost))
  (:action go
    :parameters (?from ?to - place)
    :precondition (at ?from)
    :effect (and (not (at ?from)) (at ?to) (increase (total-cost) (way ?from ?to))))
  (:action take
    :parameters (?b - box ?p - place)
    :precondition (and (at ?p) (in ?b ?p))
    :effect (and (held ?b) (not (in ?b ?p)))))
"""
PROBLEM = """(define (problem fetch)
  (:domain rooms)
  (:objects kitchen - place tea - box)
  (:init (at hall) (in tea kitchen)
    (= (way hall kitchen) 4) (= (way kitchen hall) 4))
  (:goal (held tea))
  (:metric minimize (total-cost)))
"""

# What becomes what, the line of the complaint, and words of it (of the remedy, where there is a real choice).
BAD_DOMAINS = {
    "an unknown section": ("(:constants", "(:constant", 4, "Did you mean ':constants'?"),
    "a section of the other file": (
        "(:constants hall - place)",
        "(:init (at hall))",
        4,
        "Write sections in this order",
    ),
    "derived predicates": ("(:constants hall - place)", "(:derived (a) (b))", 4, "change the predicate, too"),
    "a hierarchical method": ("(:constants hall - place)", "(:method m)", 4, "keep their order"),
    "a process": ("(:constants hall - place)", "(:process p)", 4, "Use durative actions"),
    "a section twice": ("(:constants hall - place)", "(:types a)", 4, "Write sections in this order"),
    "an unknown requirement": (":strips", ":strip", 2, "Did you mean ':strips'?"),
    "either in a list of types": ("(?b - box", "(?b - (either box place)", 12, "Declare a type above them"),
    "a type that is not declared": ("(?b - box", "(?b - bix", 12, "Did you mean 'box'?"),
    "a type of itself": ("box - thing)", "box - thing thing - box)", 3, "declared more than once"),
    "no type behind a dash": ("hall - place)", "hall -)", 4, "Write sections in this order"),
    "a dash without a name": ("(:constants hall", "(:constants", 4, "Write sections in this order"),
    "an undeclared predicate": ("(and (held ?b)", "(and (hold ?b)", 14, "Did you mean 'held'?"),
    "too few arguments": ("(in ?b ?p))\n", "(in ?b))\n", 13, "has arity 2 but 1"),
    "too many arguments": ("(held ?b) (not", "(held ?b ?p) (not", 14, "has arity 1 but 2"),
    "an unbound variable": ("(held ?b) (not", "(held ?x) (not", 14, "Undefined name found: x"),
    "an unknown object": ("(at ?from)\n", "(at hell)\n", 9, "Did you mean 'held'?"),
    "an argument of another type": ("(held ?b) (not", "(held ?p) (not", 14, "not well-formed"),
    "an undeclared function": ("(way ?from ?to))))", "(road ?from ?to))))", 10, "Known are"),
    "an object of the problem": ("(at ?from)\n", "(at kitchen)\n", 9, "Known are: at"),
    "a number instead of an object": ("(at ?from)\n", "(at 3)\n", 9, "not well-formed"),
    "a predicate twice": ("(held ?b - thing))", "(at ?p))", 5, "no two things may have one name"),
    "an action twice": ("(:action take", "(:action go", 11, "no two things may have one name"),
    "a parameter twice": ("(?b - box ?p", "(?b - box ?b", 12, "each parameter once"),
    "a parameter without a question mark": (
        "(?b - box ?p",
        "(b - box ?p",
        12,
        "Write sections in this order",
    ),
    "an unknown part of an action": (":precondition (at", ":preconditions (at", 9, "':precondition'"),
    "a part of an action twice": (
        ":precondition (at ?from)",
        ":effect (at ?from)",
        10,
        "Write sections in this order",
    ),
    "a part without brackets": (
        ":precondition (at ?from)",
        ":precondition",
        10,
        "Write sections in this order",
    ),
    "a word of PDDL as a predicate": ("(held ?b - thing))", "(and ?b))", 14, "Not able to handle"),
    "a number as a name": ("(:action take", "(:action 2take", 11, "Write sections in this order"),
    "a name with a strange letter": ("(:action take", "(:action také", 11, "Write sections in this order"),
    "not with two parts": ("(not (at ?from))", "(not (at ?from) (at ?to))", 10, "1 part after 'not'"),
    "a preference": (
        ":precondition (at ?from)",
        ":precondition (preference p (at ?from))",
        9,
        "price what should not be",
    ),
    "an object that is a function": (
        "(way ?a ?b - place)",
        "(way ?a ?b - place) - place",
        6,
        "Write sections in this order",
    ),
    "a bracket too few": ("(not (in ?b ?p)))))", "(not (in ?b ?p))))", 1, "Close the bracket"),
    "a bracket too many": (
        "(not (in ?b ?p)))))",
        "(not (in ?b ?p))))))",
        14,
        "nothing after the closing bracket",
    ),
    "two definitions": (
        "(define (domain rooms)",
        "(define (domain a)) (define (domain rooms)",
        1,
        "Keep one",
    ),
    "a negative cost": (
        "(increase (total-cost) (way ?from ?to))",
        "(increase (total-cost) -3)",
        None,
        "from 0",
    ),
}
BAD_PROBLEMS = {
    "another domain": ("(:domain rooms)", "(:domain room)", 2, "Write (:domain rooms)"),
    "an empty goal section": ("(:goal (held tea))", "(:goal)", 6, "Write sections in this order"),
    "two goals": ("(:goal (held tea))", "(:goal (held tea) (at hall))", 6, "Write sections in this order"),
    "no initial state": ("(:init", "(:inits", 4, "':init'"),
    "an object twice": ("tea - box", "tea tea - box", 3, "no two things may have one name"),
    "a number that is none": ("kitchen) 4)", "kitchen) four)", 5, "Found invalid expression: four"),
    "an endless number": ("kitchen) 4)", "kitchen) 1e999)", 5, "without an exponent"),
    "a number of many digits": ("kitchen) 4)", "kitchen) 1234567890123456)", 5, "in a larger unit"),
    "a number of a thousand digits": ("kitchen) 4)", f"kitchen) {'9' * 1000})", 5, "without an exponent"),
    "a fact without brackets": ("(at hall)", "at hall", 4, "Write sections in this order"),
    "constraints": ("(:metric", "(:constraints (and)) (:metric", 7, "as preconditions"),
    "a metric without a direction": ("minimize", "least", 7, "Write sections in this order"),
    "a metric that is a number": ("(total-cost)", "3", 7, "Write (total-cost)"),
    "a goal that contradicts itself": ("(held tea)", "(and (at hall) (not (at hall)))", 6, "exclude each"),
    "a goal of no alternatives": ("(held tea)", "(or)", 6, "a goal that can be true"),
    "an unknown object in the goal": ("(held tea)", "(held tee)", 6, "Did you mean 'tea'?"),
}


@pytest.fixture
def read(tmp_path):
    """Read two texts as files."""

    def call(domain: str | bytes, problem: str | bytes = PROBLEM):
        for name, text in (("domain.pddl", domain), ("problem.pddl", problem)):
            (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_custom(tmp_path / "domain.pddl", tmp_path / "problem.pddl")

    return call


@pytest.mark.parametrize("what", [name for name in BAD_DOMAINS if BAD_DOMAINS[name][2]])
def test_what_is_wrong_with_a_domain_is_placed_and_comes_with_a_remedy(read, what):
    good, bad, line, words = BAD_DOMAINS[what]
    assert good in DOMAIN
    with pytest.raises(InputError) as refusal:
        read(DOMAIN.replace(good, bad, 1))
    assert f"domain.pddl:{line}:" in str(refusal.value), refusal.value
    assert words in str(refusal.value)


@pytest.mark.parametrize("what", BAD_PROBLEMS)
def test_what_is_wrong_with_a_problem_is_placed_and_comes_with_a_remedy(read, what):
    good, bad, line, words = BAD_PROBLEMS[what]
    assert good in PROBLEM
    with pytest.raises(InputError) as refusal:
        read(DOMAIN, PROBLEM.replace(good, bad, 1))
    assert f"problem.pddl:{line}:" in str(refusal.value), refusal.value
    assert words in str(refusal.value)


def test_another_place_that_a_message_names_has_the_form_of_the_first(read):
    """FILE:LINE:COLUMN, also where a whole file is one line."""
    with pytest.raises(InputError) as refusal:
        read(DOMAIN, PROBLEM.replace("(= (way kitchen hall) 4)", "(= (way hall kitchen) 4)", 1))
    first, second = re.findall(r"\S*problem\.pddl(:\d+:\d+)", str(refusal.value))
    assert (first, second) == (":5:33", ":5:27")


# What becomes what in the domain: misread by unified-planning's reader, or refused by it without a place.
WITHOUT_A_PLACE = {
    "types in a circle": ("place thing - object box - thing", "place thing - box box - thing", "circle"),
    "an effect for all in one for all": (
        "(held ?b) (not",
        "(forall (?x - place) (forall (?y - box) (held ?y))) (not",
        "Nested forall",
    ),
    "a quantifier of nothing": ("(at ?from)\n", "(forall () (at ?from))\n", "at least one variable"),
    "a comparison of unlike things": ("(and (at ?p) (in", "(and (= ?b ?p) (in", "not well-formed"),
    "a difference of three": ("(way ?from ?to))))", "(- 9 3 1))))", "positional arguments"),
    "an effect under a comparison": ("(held ?b) (not", "(< 1 2) (not", "Fluent"),
}


@pytest.mark.parametrize("what", WITHOUT_A_PLACE)
def test_what_is_refused_without_a_place_names_its_file_and_the_reason(read, what):
    good, bad, words = WITHOUT_A_PLACE[what]
    assert good in DOMAIN
    with pytest.raises(InputError) as refusal:
        read(DOMAIN.replace(good, bad, 1))
    assert re.match(r"\S*domain\.pddl: ", str(refusal.value))
    assert words in str(refusal.value)


@pytest.mark.parametrize(
    "inner", ["(when (at hall) (held ?b))", "(and (forall (?x - box) (when (held ?x) (held ?b))))"]
)
def test_a_condition_inside_another_one_is_refused_where_it_would_be_misread(read, inner):
    """unified-planning's reader forgets the outer one."""
    with pytest.raises(InputError, match=r"domain\.pddl:14:\d+: .*both conditions"):
        read(DOMAIN.replace("(and (held ?b)", f"(and (when (in ?b ?p) {inner})", 1))


NO_PDDL = {
    "an empty file": b"",
    "only a comment": b"; nothing here",
    "prose": b"Dear planner, please serve the tea.",
    "YAML": b"schema_version: 1\nname: tea\n",
    "a picture": b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR",
    "another language": b"(defun plan (x) (car x))",
    "an empty pair of brackets": b"()",
    "brackets all the way down": b"(" * 100_000,
    "brackets up and down": b"(" * 50_000 + b")" * 50_000,
    "one word without an end": b"a" * 1_000_000,
}


@pytest.mark.parametrize("what", NO_PDDL)
def test_what_is_no_pddl_at_all_is_refused_by_its_name(read, what):
    with pytest.raises(InputError, match=r"domain\.pddl") as refusal:
        read(NO_PDDL[what])
    assert refusal.value.remedy


def test_swapped_files_are_called_so(read):
    with pytest.raises(InputError, match="seem to be swapped"):
        read(PROBLEM, DOMAIN)


def test_a_missing_file_and_a_folder_are_called_so(tmp_path):
    for path, words in ((tmp_path / "none.pddl", "no such file"), (tmp_path, "a folder")):
        with pytest.raises(InputError, match=words):
            read_custom(path, path)


def refusal_of(reading) -> InputError | None:
    """How a reading ended; any other exception is a failure."""
    try:
        reading()
    except InputError as refusal:
        return refusal
    return None


@given(st.binary(max_size=300))
def test_random_bytes_never_get_through_as_anything_but_an_input_error(data):
    refusal = refusal_of(lambda: parsed(data.decode("utf-8", "replace"), "random"))
    assert refusal is None or refusal.where is not None


@settings(max_examples=60)
@given(seed=st.integers(0, 2**32))
def test_any_word_dropped_doubled_or_swapped_is_read_or_refused(seed, tmp_path_factory):
    """Mutations of good files: never another exception."""
    draw, folder = random.Random(seed), tmp_path_factory.mktemp("mutant")
    for name, text in (("domain.pddl", DOMAIN), ("problem.pddl", PROBLEM)):
        words = text.replace("(", " ( ").replace(")", " ) ").split(" ")
        for _ in range(draw.choice((0, 1, 1, 2))):
            at, other = draw.randrange(len(words)), draw.randrange(len(words))
            words[at] = draw.choice(("", f"{words[at]} {words[at]}", words[other], "(", ")", "-"))
        (folder / name).write_text(" ".join(words))
    refusal = refusal_of(lambda: read_custom(folder / "domain.pddl", folder / "problem.pddl"))
    assert refusal is None or (refusal.where and refusal.remedy)


TYPES = "  (:types place thing - object box - thing)\n"
TAKEN = "(and (held ?b) (not (in ?b ?p)))"
BOTH_QUANTIFIERS = "(and (exists (?b - box) (held ?b)) (forall (?b - box) (or (held ?b) (at hall))))"
OVER_EVERYTHING = "(and (held tea) (exists (?x) (= ?x hall)) (forall (?y - object) (= ?y ?y)))"
EMPTIED = "(and (held ?b) (forall (?o - box) (when (in ?o ?p) (not (in ?o ?p)))))"
PRECONDITION = ":precondition (at ?from)"

# What is replaced in the domain, and in the problem.
UNUSUAL = {
    "no requirements": ([("(:requirements :strips :typing :action-costs)", "")], []),
    "mixed case": ([("(held ?b -", "(HELD ?b -"), ("take", "Take")], [("tea)", "TEA)"), ("tea -", "TEA -")]),
    "dashes and underscores": ([("take", "pick-up_now")], [("tea", "green-tea")]),
    "Python's keywords": ([("take", "lambda"), ("held", "class")], [("tea", "None"), ("held", "class")]),
    "an object named like a word of PDDL": ([], [("tea", "and")]),
    "comments and tabs": ([("  ", "\t; a comment with ( in it\n")], []),
    "Windows line ends and a byte order mark": ([("\n", "\r\n"), ("(define", "\ufeff(define")], []),
    "quantifiers": ([], [("(held tea)", BOTH_QUANTIFIERS)]),
    "conditional effects": ([(TAKEN, EMPTIED)], []),
    "an equality": ([(PRECONDITION, ":precondition (and (at ?from) (not (= ?from ?to)))")], []),
    "a goal that holds of itself, beside another": (
        [],
        [("(held tea)", "(and (held tea) (= hall hall) (not (= hall kitchen)))")],
    ),
    "an empty precondition": ([(PRECONDITION, ":precondition ()")], []),
    "a negative fact": ([], [("(at hall)", "(at hall) (not (at kitchen))")]),
    "fractions of a cost": ([], [("kitchen) 4)", "kitchen) 4.25)")]),
    "no metric": ([], [("(:metric minimize (total-cost))", "")]),
    "names that planners use themselves": ([("take", "new-axiom")], [("tea", "number")]),
}

# Right, and not read by unified-planning: what is replaced in the domain, and in the problem; what to write.
REFUSED = {
    "sections in another order": (
        [(TYPES, ""), ("  (:functions", f"{TYPES}  (:functions")],
        [],
        "Write sections in this order",
    ),
    "an object named like a type": ([], [("tea", "box")], "no two things"),
    "an action named like a predicate": ([(":action take", ":action held")], [], "no two things"),
    "an action named like an object": ([(":action take", ":action tea")], [], "no two things"),
    "a type named like a predicate": ([("box", "in")], [("box", "in")], "no two things"),
    "parts in another order": (
        [(f"{PRECONDITION}\n", ""), ("(way ?from ?to))))", f"(way ?from ?to)))\n {PRECONDITION})")],
        [],
        "Write sections in this order",
    ),
    "a quantifier over everything": ([], [("(held tea)", OVER_EVERYTHING)], "Give it a type"),
    "an object without a type": ([], [("tea - box", "tea - box what")], "Give it a type"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_right_and_not_read_says_what_to_write(read, what):
    domain, problem = changed(*REFUSED[what][:2])
    with pytest.raises(InputError) as refusal:
        read(domain, problem)
    assert REFUSED[what][2] in refusal.value.remedy


PLANNED = (
    "mixed case",
    "Python's keywords",
    "an object named like a word of PDDL",
    "quantifiers",
    "conditional effects",
    "a goal that holds of itself, beside another",
    "fractions of a cost",
    "names that planners use themselves",
)
"""What could trouble the planner, too: the others need not go through it."""


@pytest.mark.parametrize("what", UNUSUAL)
def test_what_is_unusual_but_right_is_read(read, what):
    """To go to the kitchen and to take the tea works by unified-planning's validator, and costs 4."""
    domain, problem = changed(*UNUSUAL[what])
    bound = bind(read(domain, problem))
    go, take = bound.problem.actions
    tea = next(one.name for one in bound.problem.objects(take.parameters[0].type))
    plan = [GroundAction(go.name, ("hall", "kitchen")), GroundAction(take.name, (tea, "kitchen"))]
    assert works(plan, bound)
    cost = sum(row_of(action, bound).cost for action in plan)
    assert cost == (4.25 if "4.25" in problem else 4) * bound.binding.cost_scale


@pytest.mark.parametrize("what", PLANNED)
def test_what_could_trouble_the_planner_is_planned(read, what):
    """The names in the plan are those of the files."""
    domain, problem = changed(*UNUSUAL[what])
    bound = bind(read(domain, problem))
    plan = plan_custom(bound).plan
    actions = [
        GroundAction(step.action.lower(), tuple(map(str.lower, step.arguments))) for step in plan.steps
    ]
    assert works(actions, bound)
    said = {word for step in plan.steps for word in (step.action, *step.arguments)}
    assert all(word in domain + problem for word in said)


def changed(in_domain, in_problem) -> tuple[str, str]:
    domain, problem = DOMAIN, PROBLEM
    for good, unusual in in_domain:
        assert good in domain
        domain = domain.replace(good, unusual)
    for good, unusual in in_problem:
        assert good in problem
        problem = problem.replace(good, unusual)
    return domain, problem


def test_one_more_bracket_is_refused_where_it_stands(read):
    deep = "(and " * MAX_DEPTH + "(held tea)" + ")" * MAX_DEPTH
    with pytest.raises(InputError, match=rf":6:\d+: expected at most {MAX_DEPTH} nested brackets"):
        read(DOMAIN, PROBLEM.replace("(held tea)", deep))


def test_a_cost_below_zero_is_refused(read):
    good, bad, _, words = BAD_DOMAINS["a negative cost"]
    own = read(DOMAIN.replace(good, bad, 1))
    with pytest.raises(InputError, match=words):
        bind(own)
