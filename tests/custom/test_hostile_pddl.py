"""Whatever is wrong with PDDL ends with its file, its line and a remedy; what can be read is read."""

from __future__ import annotations

import random
import re
import sys
from itertools import accumulate
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_domain.custom import bind, plan_custom, read_custom
from comity_domain.custom.costs.cost import MAX_GROUNDED
from comity_domain.custom.engines.fast_downward import GroundAction
from comity_domain.custom.pddl.form import MAX_BYTES, MAX_DEPTH, MAX_WORDS, parse_form
from comity_domain.custom.pddl.names import MOST_NAMES
from comity_domain.custom.pddl.reading import without_place
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
    "a section of the other file": ("(:constants hall - place)", "(:init (at hall))", 4, "problem file"),
    "derived predicates": ("(:constants hall - place)", "(:derived (a) (b))", 4, "write the condition out"),
    "a hierarchical method": ("(:constants hall - place)", "(:method m)", 4, "plain actions"),
    "a process": ("(:constants hall - place)", "(:process p)", 4, "durative actions"),
    "a section twice": ("(:constants hall - place)", "(:types a)", 4, "Join the two"),
    "an unknown requirement": (":strips", ":strip", 2, "Did you mean ':strips'?"),
    "either in a list of types": ("(?b - box", "(?b - (either box place)", 12, "Declare a type above them"),
    "a type that is not declared": ("(?b - box", "(?b - bix", 12, "Did you mean 'box'?"),
    "a type of itself": ("box - thing)", "box - thing thing - box)", 3, "each type once"),
    "types in a circle": ("place thing - object box - thing", "place thing - box box - thing", 3, "circle"),
    "no type behind a dash": ("hall - place)", "hall -)", 4, "a type after '-'"),
    "a dash without a name": ("(:constants hall", "(:constants", 4, "a constant before the type"),
    "an undeclared predicate": ("(and (held ?b)", "(and (hold ?b)", 14, "Did you mean 'held'?"),
    "too few arguments": ("(in ?b ?p))\n", "(in ?b))\n", 13, "2 arguments of predicate in"),
    "too many arguments": ("(held ?b) (not", "(held ?b ?p) (not", 14, "1 argument of predicate held"),
    "an unbound variable": ("(held ?b) (not", "(held ?x) (not", 14, "a variable in scope"),
    "an unknown object": ("(at ?from)\n", "(at hell)\n", 9, "Did you mean 'hall'?"),
    "an argument of another type": ("(held ?b) (not", "(held ?p) (not", 14, "something of type thing"),
    "an undeclared function": ("(way ?from ?to))))", "(road ?from ?to))))", 10, "a declared function"),
    "an effect for all in one for all": (
        "(held ?b) (not",
        "(forall (?x - place) (forall (?y - box) (held ?y))) (not",
        14,
        "Join the two",
    ),
    "a quantifier of nothing": ("(at ?from)\n", "(forall () (at ?from))\n", 9, "a variable behind forall"),
    "a quantifier with a variable twice": ("(at ?from)\n", "(exists (?x ?x) (at ?from))\n", 9, "once"),
    "a comparison of unlike things": ("(and (at ?p) (in", "(and (= ?b ?p) (in", 13, "box and place"),
    "a division by 0": ("(way ?from ?to))))", "(/ (way ?from ?to) 0.0))))", 10, "a divisor that is not 0"),
    "a sum of nothing": ("(way ?from ?to))))", "(+))))", 10, "a number after '+'"),
    "a difference of three": ("(way ?from ?to))))", "(- 9 3 1))))", 10, "2 parts after '-'"),
    "an object of the problem": ("(at ?from)\n", "(at kitchen)\n", 9, "into (:constants ...)"),
    "a number instead of an object": ("(at ?from)\n", "(at 3)\n", 9, "an object or a variable"),
    "a predicate twice": ("(held ?b - thing))", "(at ?p))", 5, "each predicate once"),
    "an action twice": ("(:action take", "(:action go", 11, "each action once"),
    "no blank behind a dash": ("(?b - box", "(?b -box", 12, "Write '- box'."),
    "a second cost": ("(at ?to) (inc", "(increase (total-cost) 3) (inc", 10, "(+ 3 (way ?from ?to))"),
    "a cost for each of many": (
        "(at ?to) (increase (total-cost) (way ?from ?to))",
        "(at ?to) (forall (?x - place) (increase (total-cost) 2))",
        10,
        "a cost outside of forall",
    ),
    "a parameter twice": ("(?b - box ?p", "(?b - box ?b", 12, "each parameter once"),
    "a parameter without a question mark": ("(?b - box ?p", "(b - box ?p", 12, "question mark"),
    "an unknown part of an action": (":precondition (at", ":preconditions (at", 9, "':precondition'"),
    "a part of an action twice": (":precondition (at ?from)", ":effect (at ?from)", 10, "a second one"),
    "a part without brackets": (
        ":precondition (at ?from)",
        ":precondition",
        9,
        "brackets after :precondition",
    ),
    "a word of PDDL as a predicate": ("(held ?b - thing))", "(and ?b))", 5, "PDDL does not use"),
    "a number as a name": ("(:action take", "(:action 2take", 11, "starts with a letter"),
    "a name with a strange letter": ("(:action take", "(:action také", 11, "Rename it here"),
    "not with two parts": ("(not (at ?from))", "(not (at ?from) (at ?to))", 10, "Write (not (...))"),
    "an assignment to a word": ("(increase (total-cost)", "(increase total-cost", 10, "Write (total-cost)"),
    "an effect under a comparison": ("(held ?b) (not", "(< 1 2) (not", 14, "a declared predicate"),
    "a preference": (":precondition (at ?from)", ":precondition (preference p (at ?from))", 9, "PDDL 2.1"),
    "an object that is a function": ("(way ?a ?b - place)", "(way ?a ?b - place) - place", 6, "- number"),
    "a bracket too few": ("(not (in ?b ?p)))))", "(not (in ?b ?p))))", 1, "Close the bracket"),
    "a bracket too many": ("(not (in ?b ?p)))))", "(not (in ?b ?p))))))", 14, "one ')' more"),
    "two definitions": (
        "(define (domain rooms)",
        "(define (domain a)) (define (domain rooms)",
        1,
        "Keep one",
    ),
    "no actions": (DOMAIN[DOMAIN.index("(:action go") :], ")", 1, "at least one action"),
    "a negative cost": (
        "(increase (total-cost) (way ?from ?to))",
        "(increase (total-cost) -3)",
        None,
        "from 0",
    ),
}
BAD_PROBLEMS = {
    "another domain": ("(:domain rooms)", "(:domain room)", 2, "Write (:domain rooms)"),
    "no goal": ("(:goal (held tea))", "", 1, "(:goal ...)"),
    "an empty goal section": ("(:goal (held tea))", "(:goal)", 6, "one goal in brackets"),
    "two goals": ("(:goal (held tea))", "(:goal (held tea) (at hall))", 6, "Join several with (and ...)"),
    "no initial state": ("(:init", "(:inits", 4, "':init'"),
    "an object twice": ("tea - box", "tea tea - box", 3, "each object once"),
    "an object that is a constant": ("kitchen - place", "kitchen hall - place", 3, "which is a constant"),
    "a number that is none": ("kitchen) 4)", "kitchen) four)", 5, "Write the number out"),
    "an endless number": ("kitchen) 4)", "kitchen) 1e999)", 5, "without an exponent"),
    "a number of many digits": ("kitchen) 4)", "kitchen) 1234567890123456)", 5, "in a larger unit"),
    "a number of a thousand digits": ("kitchen) 4)", f"kitchen) {'9' * 1000})", 5, "without an exponent"),
    "a variable in the initial state": ("(at hall)", "(at ?x)", 4, "a variable in scope"),
    "a fact without brackets": ("(at hall)", "at hall", 4, "Put it into brackets"),
    "constraints": ("(:metric", "(:constraints (and)) (:metric", 7, "preconditions and goals"),
    "a metric without a direction": ("minimize", "least", 7, "minimize or maximize"),
    "a metric that is a number": ("(total-cost)", "3", 7, "an expression in brackets"),
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


@pytest.mark.parametrize(
    ("good", "bad", "place"),
    [
        ("(at ?p - place) (in", "(at ?p - place) (at) (in", ":5:17"),
        ("(way ?a ?b - place)", "(way ?a ?b - place) (way)", ":6:16"),
        ("(at hall) (in tea", "(at) (in tea", ":5:17"),
        ("(way ?from ?to))))", "(way ?from ?to)) (increase (total-cost) 1)))", ":10:44"),
        ("(= (way kitchen hall) 4)", "(= (way hall kitchen) 4)", ":5:5"),
    ],
)
def test_another_place_that_a_message_names_has_the_form_of_the_first(read, good, bad, place):
    """FILE:LINE:COLUMN, also where a whole file is one line."""
    with pytest.raises(InputError) as refusal:
        read(DOMAIN.replace(good, bad, 1), PROBLEM.replace(good, bad, 1))
    _, second = re.findall(r"\S*(?:domain|problem)\.pddl(:\d+:\d+)", str(refusal.value))
    assert second == place


@pytest.mark.parametrize(
    "said",
    [
        "Not able to handle: (a), from line: 3, col 4 to line: 3, col 7",
        "Not able to handle: (a) found at line: 3, col 4 to line: 3, col 7",
        "Not able to handle: (a). From line: 12, col: 4 to line: 13, col: 7.",
    ],
)
def test_a_place_in_the_text_that_was_made_of_a_file_is_not_passed_on(said):
    assert without_place(said) == "Not able to handle: (a)"


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
    "a million words": b"(define (domain d) " + b"x " * 900_000 + b")",
    "too many bytes": b" " * 2_000_001,
    "null bytes": b"(define (domain d\x00))",
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
    refusal = refusal_of(lambda: parse_form(data.decode("utf-8", "replace"), "random"))
    assert refusal is None or refusal.where is not None


@settings(max_examples=60)
@given(seed=st.integers(0, 2**32))
def test_any_word_dropped_doubled_or_swapped_is_read_or_refused_with_a_line(seed, tmp_path_factory):
    """Mutations of good files: never another exception."""
    draw, folder = random.Random(seed), tmp_path_factory.mktemp("mutant")
    for name, text in (("domain.pddl", DOMAIN), ("problem.pddl", PROBLEM)):
        words = text.replace("(", " ( ").replace(")", " ) ").split(" ")
        for _ in range(draw.choice((0, 1, 1, 2))):
            at, other = draw.randrange(len(words)), draw.randrange(len(words))
            words[at] = draw.choice(("", f"{words[at]} {words[at]}", words[other], "(", ")", "-"))
        (folder / name).write_text(" ".join(words))
    refusal = refusal_of(lambda: read_custom(folder / "domain.pddl", folder / "problem.pddl"))
    assert refusal is None or (refusal.where and refusal.where.line and refusal.remedy)


TYPES = "  (:types place thing - object box - thing)\n"
TAKEN = "(and (held ?b) (not (in ?b ?p)))"
BOTH_QUANTIFIERS = "(and (exists (?b - box) (held ?b)) (forall (?b - box) (or (held ?b) (at hall))))"
OVER_EVERYTHING = "(and (held tea) (exists (?x) (= ?x hall)) (forall (?y - object) (= ?y ?y)))"
EMPTIED = "(and (held ?b) (forall (?o - box) (when (in ?o ?p) (not (in ?o ?p)))))"
PRECONDITION = ":precondition (at ?from)"

# What is replaced in the domain, and in the problem.
UNUSUAL = {
    "sections in another order": ([(TYPES, ""), ("  (:functions", f"{TYPES}  (:functions")], []),
    "no requirements": ([("(:requirements :strips :typing :action-costs)", "")], []),
    "mixed case": ([("(held ?b -", "(HELD ?b -"), ("take", "Take")], [("tea)", "TEA)"), ("tea -", "TEA -")]),
    "dashes and underscores": ([("take", "pick-up_now")], [("tea", "green-tea")]),
    "Python's keywords": ([("take", "lambda"), ("held", "class")], [("tea", "None"), ("held", "class")]),
    "an object named like a type": ([], [("tea", "box")]),
    "an object named like a word of PDDL": ([], [("tea", "and")]),
    "an action named like a predicate": ([(":action take", ":action held")], []),
    "an action named like an object": ([(":action take", ":action tea")], []),
    "a type named like a predicate": ([("box", "in")], [("box", "in")]),
    "parts in another order": (
        [(f"{PRECONDITION}\n", ""), ("(way ?from ?to))))", f"(way ?from ?to)))\n {PRECONDITION})")],
        [],
    ),
    "comments and tabs": ([("  ", "\t; a comment with ( in it\n")], []),
    "Windows line ends and a byte order mark": ([("\n", "\r\n"), ("(define", "\ufeff(define")], []),
    "quantifiers": ([], [("(held tea)", BOTH_QUANTIFIERS)]),
    "a quantifier over everything": ([], [("(held tea)", OVER_EVERYTHING)]),
    "a quantifier over everything, of types that are declared in another order": (
        [("place thing - object box - thing", "box - thing thing - object place - object")],
        [("(held tea)", "(and (held tea) (exists (?x) (= ?x hall)) (exists (?x) (= ?x tea)))")],
    ),
    "an object without a type": ([], [("tea - box", "tea - box what")]),
    "conditional effects": ([(TAKEN, EMPTIED)], []),
    "an equality": ([(PRECONDITION, ":precondition (and (at ?from) (not (= ?from ?to)))")], []),
    "a goal that holds of itself, beside another": (
        [],
        [("(held tea)", "(and (held tea) (= hall hall) (not (= hall kitchen)))")],
    ),
    "a quantifier in the condition of an effect for all": (
        [
            (
                TAKEN,
                "(and (held ?b) (forall (?x - place) (when (forall (?y) (= ?y ?y)) (not (in ?b ?x)))))",
            )
        ],
        [],
    ),
    "an empty precondition": ([(PRECONDITION, ":precondition ()")], []),
    "a negative fact": ([], [("(at hall)", "(at hall) (not (at kitchen))")]),
    "fractions of a cost": ([], [("kitchen) 4)", "kitchen) 4.25)")]),
    "no metric": ([], [("(:metric minimize (total-cost))", "")]),
    "names that planners use themselves": ([("take", "new-axiom")], [("tea", "number")]),
}


PLANNED = (
    "mixed case",
    "Python's keywords",
    "an object named like a type",
    "an object named like a word of PDDL",
    "an action named like a predicate",
    "quantifiers",
    "conditional effects",
    "a goal that holds of itself, beside another",
    "a quantifier in the condition of an effect for all",
    "fractions of a cost",
    "names that planners use themselves",
)
"""What could trouble the planner, too: the others need not go through it."""


@pytest.mark.parametrize("what", UNUSUAL)
def test_what_is_unusual_but_right_is_read(read, what):
    """To go to the kitchen and to take the tea works by unified-planning's validator, and costs 4."""
    domain, problem = changed(what)
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
    domain, problem = changed(what)
    bound = bind(read(domain, problem))
    plan = plan_custom(bound).plan
    name = bound.own.own_name
    actions = [
        GroundAction(name("action", step.action), tuple(name("object", one) for one in step.arguments))
        for step in plan.steps
    ]
    assert works(actions, bound)
    said = {word for step in plan.steps for word in (step.action, *step.arguments)}
    assert all(word in domain + problem for word in said)


def changed(what: str) -> tuple[str, str]:
    domain, problem = DOMAIN, PROBLEM
    for good, unusual in UNUSUAL[what][0]:
        assert good in domain
        domain = domain.replace(good, unusual)
    for good, unusual in UNUSUAL[what][1]:
        assert good in problem
        problem = problem.replace(good, unusual)
    return domain, problem


def depth(text: str) -> int:
    return max(accumulate({"(": 1, ")": -1}.get(letter, 0) for letter in text))


def nested(text: str, inner: str, layer: str) -> str:
    """As many layers, each with a `*` for what is in it, around a part of a text as may be."""
    while depth(wrapped := text.replace(inner, layer.replace("*", inner), 1)) <= MAX_DEPTH:
        text, inner = wrapped, layer.replace("*", inner)
    return text


LAYERS = ("(and *)", "(or (at hall) *)", "(not (not *))", "(exists (?x - box) *)", "(imply (at ?p) *)")


def called_deep(levels: int, call):
    """As from a program that is itself many calls deep."""
    return call() if levels == 0 else called_deep(levels - 1, call)


@pytest.mark.parametrize("layer", LAYERS)
def test_nesting_up_to_the_limit_is_planned_however_deep_the_caller_is(read, layer):
    domain = nested(DOMAIN, "(in ?b ?p)", layer)
    problem = nested(PROBLEM, "(held tea)", layer.replace("?p", "hall"))
    assert MAX_DEPTH - 1 <= depth(domain) <= MAX_DEPTH
    assert MAX_DEPTH - 1 <= depth(problem) <= MAX_DEPTH
    before = sys.getrecursionlimit()
    plan = called_deep(before // 2, lambda: plan_custom(bind(read(domain, problem))).plan)
    assert plan.optimal
    assert sys.getrecursionlimit() == before


def test_a_sum_nested_up_to_the_limit_is_reckoned(read):
    domain = nested(DOMAIN, "(way ?from ?to)", "(+ 1 *)")
    assert depth(domain) == MAX_DEPTH
    assert plan_custom(bind(read(domain))).plan.cost == 4 + domain.count("(+ 1")


def test_the_page_tells_the_limits_that_hold():
    page = Path(__file__).parents[2] / "docs" / "how-to" / "use-a-custom-domain.md"
    limits = page.read_text(encoding="utf-8").split("\nLimits: ")[1]
    assert f"{MAX_BYTES / 1e6:g} MB, {MAX_WORDS:,} words, {MOST_NAMES:,} objects" in limits
    assert f"{MAX_DEPTH} nested brackets for each file, {MAX_GROUNDED:,} combinations" in limits


def test_one_more_bracket_is_refused_where_it_stands(read):
    deep = "(and " * MAX_DEPTH + "(held tea)" + ")" * MAX_DEPTH
    with pytest.raises(InputError, match=rf":6:\d+: expected at most {MAX_DEPTH} nested brackets"):
        read(DOMAIN, PROBLEM.replace("(held tea)", deep))


def test_a_cost_below_zero_is_refused(read):
    good, bad, _, words = BAD_DOMAINS["a negative cost"]
    own = read(DOMAIN.replace(good, bad, 1))
    with pytest.raises(InputError, match=words):
        bind(own)
