"""Fuzzy systems in plain words that every competitor can be built from, taken from rulebooks."""

from __future__ import annotations

from itertools import product
from typing import Any

from comity_fis import NominalParameter, NominalVariable, NumericVariable, Rule, Rulebook
from comity_fis.membership.function import Trapezoid, TwoTermGaussian
from comity_fis.rules.rule import And, Is

Description = dict[str, Any]
"""`inputs` and `outputs` by name with `range`, `categories` (their number, 0 for numbers) and `terms`, each a
shape; `rules` with `if` and `then` as lists of [name, term]; `answer`: the output to compare; `rulebook` or
`yaml`: where ours comes from."""


def described(rulebook: Rulebook, *, answer: str) -> Description:
    """A rulebook as far as other libraries can have it: rules that join terms of variables by `and`.

    Categories become numbers, each term a narrow trapezoid around one.
    """
    plain = [rule for rule in rulebook.rules if _is_plain(rule, rulebook)]
    read = {name for rule in plain for name in rule.reads}
    given = {is_.name for rule in plain for is_ in rule.consequents}
    return {
        "inputs": {name: _variable(v) for name, v in rulebook.variables.items() if name in read},
        "outputs": {name: _parameter(p) for name, p in rulebook.parameters.items() if name in given},
        "rules": [
            {
                "if": [[part.name, part.term] for part in _parts(rule)],
                "then": [[is_.name, is_.term] for is_ in rule.consequents],
            }
            for rule in plain
        ],
        "answer": answer,
        "rulebook": rulebook.name,
    }


def grid(terms: tuple[int, ...] = (3, 3, 3, 2, 2, 5), *, rules: int | None = None) -> Description:
    """As many inputs as numbers, each with so many triangles, and a rule for every combination (540)."""
    inputs = {
        f"x{i}": {"range": [0.0, 1.0], "categories": 0, "terms": _triangles(n)} for i, n in enumerate(terms)
    }
    output = _triangles(5)
    combinations = list(product(*(range(n) for n in terms)))
    # Spread over the whole grid, so that a part of the rules is like all of them.
    step = 1 if rules is None else max(1, len(combinations) // rules)
    return {
        "inputs": inputs,
        "outputs": {"y": {"range": [0.0, 1.0], "categories": 0, "terms": output}},
        "rules": [
            {
                "if": [[f"x{i}", f"t{t}"] for i, t in enumerate(combination)],
                "then": [["y", f"t{sum(combination) * 5 // (sum(terms) - len(terms) + 1)}"]],
            }
            for combination in combinations[::step]
        ],
        "answer": "y",
        "yaml": True,
    }


def gaussians() -> Description:
    """Two inputs and one output, each with three Gaussians, and a rule for every combination (9)."""
    terms = {f"t{i}": _gaussian(i / 2, 0.18) for i in range(3)}
    variable = {"range": [0.0, 1.0], "categories": 0, "terms": terms}
    return {
        "inputs": {"x": variable, "y": variable},
        "outputs": {"z": variable},
        "rules": [
            {"if": [["x", f"t{i}"], ["y", f"t{j}"]], "then": [["z", f"t{(i + j) // 2}"]]}
            for i, j in product(range(3), repeat=2)
        ],
        "answer": "z",
        "yaml": True,
    }


def as_yaml(description: Description) -> str:
    """A description over numbers as one of our rulebooks."""
    from comity_fis.validation.yaml_file import dump_yaml

    def terms(of: Description) -> dict[str, Any]:
        return dict(of["terms"])

    rules = [
        {
            "rule": "if "
            + " and ".join(f"{name} is {term}" for name, term in rule["if"])
            + " then "
            + " and ".join(f"{name} is {term}" for name, term in rule["then"]),
            "sources": ["bench"],
            "evidence": "design",
        }
        for rule in description["rules"]
    ]
    return dump_yaml(
        {
            "schema_version": 1,
            "name": "bench",
            "description": "made for the bench",
            "sources": {"bench": {"citation": "none", "verified": "nothing to verify"}},
            "variables": {
                name: {
                    "kind": "culture",
                    "level": "interval",
                    "range": of["range"],
                    "terms": terms(of),
                    "shapes": "design",
                    "reason": "made for the bench",
                }
                for name, of in description["inputs"].items()
            },
            "parameters": {
                name: {
                    "kind": "action",
                    "level": "interval",
                    "unit": "1",
                    "rules": of["range"],
                    "ask": of["range"],
                    "terms": terms(of),
                    "shapes": "design",
                    "neutral": sum(of["range"]) / 2,
                    "spread": 1.0,
                    "reasons": dict.fromkeys(("ranges", "terms", "neutral", "spread"), "made for the bench"),
                }
                for name, of in description["outputs"].items()
            },
            "rules": rules,
        }
    )


def _is_plain(rule: Rule, rulebook: Rulebook) -> bool:
    return all(isinstance(part, Is) and part.name in rulebook.variables for part in _parts(rule))


def _parts(rule: Rule) -> tuple[Any, ...]:
    return rule.antecedent.parts if isinstance(rule.antecedent, And) else (rule.antecedent,)


def _variable(variable: Any) -> Description:
    if isinstance(variable, NumericVariable):
        terms = {name: _shape(term) for name, term in variable.terms.items()}
        return {"range": list(variable.domain.ends), "categories": 0, "terms": terms}
    assert isinstance(variable, NominalVariable)
    return _categories(variable.categories)


def _parameter(parameter: Any) -> Description:
    if isinstance(parameter, NominalParameter):
        return _categories(parameter.terms)
    terms = {name: _shape(term) for name, term in parameter.terms.items()}
    return {"range": list(parameter.rules.ends), "categories": 0, "terms": terms}


def _categories(names: tuple[str, ...]) -> Description:
    terms = {name: {"trapezoid": [i - 0.4, i - 0.2, i + 0.2, i + 0.4]} for i, name in enumerate(names)}
    return {"range": [-0.5, len(names) - 0.5], "categories": len(names), "terms": terms}


def _shape(term: Any) -> Description:
    if isinstance(term, Trapezoid):
        return {"trapezoid": list(term.knots)}
    assert isinstance(term, TwoTermGaussian)
    return {"two_term_gaussian": [[b.height, b.centre, b.width] for b in (term.first, term.second)]}


def _gaussian(centre: float, sigma: float) -> Description:
    """As two bumps, of which one has no height: the factor 2 of a normal density is in the width."""
    width = sigma * 2**0.5
    return {"two_term_gaussian": [[1.0, centre, width], [0.0, centre, width]]}


def _triangles(count: int) -> dict[str, Description]:
    """Evenly spaced, each reaching to its neighbours' tops."""
    step = 1 / (count - 1)
    corners = [[max(0.0, (i - 1) * step), i * step, i * step, min(1.0, (i + 1) * step)] for i in range(count)]
    return {f"t{i}": {"trapezoid": corner} for i, corner in enumerate(corners)}
