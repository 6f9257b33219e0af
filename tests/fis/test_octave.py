"""Our reading and evaluation of `.fis` files, held against GNU Octave's toolkit under Octave's own rules.

Octave runs where it is installed; elsewhere its stored answers stand in (`octave.py` makes them again).
"""

from __future__ import annotations

import json

import numpy as np
import octave
import pytest

from comity_fis.matlab.reader import parse_fis

STORED = json.loads(octave.ANSWERS.read_text())
VARIANTS = octave.variants()
MAXIMA = {"mom": np.mean, "som": np.min, "lom": np.max}
"""MATLAB's som and lom go by magnitude, which Octave's manual says and its code does not do."""


@pytest.fixture(scope="module")
def asked():
    """Octave's answers: of now where it runs, else the stored ones."""
    return octave.ask() or STORED["answers"]


def octaves_rule(curve, method):
    """Octave's number for one of our output sets: areas by trapezoids, otherwise samples as MATLAB's."""
    xs = np.linspace(*curve.domain, octave.POINTS)
    degrees = np.array([curve.degree(x) for x in xs.tolist()])
    if method in MAXIMA:
        return MAXIMA[method](xs[degrees == degrees.max()])
    if method == "centroid":
        return float(np.trapezoid(xs * degrees, xs) / np.trapezoid(degrees, xs))
    areas = np.concatenate([[0], np.cumsum((degrees[1:] + degrees[:-1]) / 2)])
    return int(np.searchsorted(areas, areas[-1] / 2)) + 1  # an index from 1, found by a search of its own


@pytest.mark.parametrize("name", VARIANTS)
def test_octave_gives_the_same_answers(asked, name):
    text, base = VARIANTS[name]
    rulebook = parse_fis(text, f"{name}.fis")
    method = rulebook.methods.defuzzification
    for row, theirs in zip(octave.INPUTS[base], asked[name], strict=True):
        inference = rulebook.infer(dict(zip(rulebook.variables, row, strict=True)), mode="matlab")
        for value, expected in zip(inference.parameters.values(), theirs, strict=True):
            ours = octaves_rule(value.desirability, method)
            # Octave halves indexes until they meet, one or two beside the place where the area is halved.
            tolerance = 2 if method == "bisector" else 1e-9 * np.ptp(value.desirability.domain)
            assert ours == pytest.approx(expected, abs=tolerance), (row, value.name)


def test_every_system_and_method_has_a_stored_answer():
    assert STORED["origin"].startswith("GNU Octave ")
    assert set(STORED["answers"]) == set(VARIANTS)
    for name, rows in STORED["answers"].items():
        assert len(rows) == len(octave.INPUTS[VARIANTS[name][1]])


def test_the_stored_answers_are_octaves_answers(asked):
    for name, rows in STORED["answers"].items():
        assert np.array(rows) == pytest.approx(np.array(asked[name]), rel=1e-9), name
