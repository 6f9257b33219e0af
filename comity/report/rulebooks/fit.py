"""What a column of data gave: clusters by radius, terms with their errors, the variable as YAML."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from comity.answers.fit import ClusterCount, FitAnswer, FittedTermAnswer
from comity.report.text import table
from comity_fis import variable_data
from comity_fis.membership.function import TwoTermGaussian
from comity_fis.rulebook.models import LONGEST_NAME
from comity_fis.validation.yaml_file import dump_yaml
from comity_fis.variables.resolution import resolved

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.tables.fit import Fit

MARK = "# Written by `comity fit`."


def fit_answer(fit: Fit, files: tuple[str, ...] = ()) -> FitAnswer:
    """The answer of `comity fit --json`."""
    values = fit.column.values
    return FitAnswer(
        file=fit.column.file,
        column=fit.column.name,
        values=len(values),
        empty=fit.column.empty,
        low=min(values),
        high=max(values),
        radius=fit.radius,
        clusters=tuple(ClusterCount(radius=r, clusters=count) for r, count in fit.counts.items()),
        radius_for_more=fit.radius_for_more,
        terms=_terms(fit),
        variable=variable_data(fit.variable) if fit.variable else None,
        files=files,
    )


def fit_text(fit: Fit) -> Iterator[RenderableType]:
    """The same, for a person to read."""
    column, values = fit.column, fit.column.values
    empty = f", {column.empty} empty or NA cells skipped" if column.empty else ""
    yield f"{column.name}: {len(values)} values from {min(values):g} to {max(values):g}{empty}"
    yield "\nClusters by radius"
    yield table([(radii, str(count), used) for radii, count, used in _runs(fit)])
    if fit.variable is None:
        yield f"\nOne cluster at radius {fit.radius:g}: these data name no terms."
        more = fit.radius_for_more
        yield (
            f"A radius of {more:g} gives {fit.counts[more]}. One cluster may be the truth all the same."
            if more
            else f"No radius down to {min(fit.counts):g} gives more."
        )
        return
    if fit.variable.name != column.name:
        yield (
            f"\nThe variable is called {fit.variable.name!r}: a name has no quotes and "
            f"at most {LONGEST_NAME} characters."
        )
    yield f"\nTerms at radius {fit.radius:g}"
    span = max(values) - min(values)
    terms = _terms(fit)
    yield table(
        [
            (
                name,
                resolved(term.centre, span),
                f"{term.squared_error:.5f}",
                f"{term.largest_error:.3f}",
                term.form,
            )
            for name, term in terms.items()
        ],
        head=("term", "centre", "squared error of the fit", "largest error", "form"),
    )
    if any(term.because for term in terms.values()):
        yield from (f"  {name} is held: {term.because}." for name, term in terms.items() if term.because)
        yield HELD


HELD = (
    "  A free fit, the paper's, sees the values only. A held one has one peak, and follows fuzzy c-means "
    "over the whole range."
)


def variable_yaml(fit: Fit) -> str:
    """The variable as a rulebook's `variables:` takes it, with a first line that says who wrote it."""
    if fit.variable is None:
        raise ValueError("one cluster makes no variable")
    return f"{MARK}\n{dump_yaml({fit.variable.name: variable_data(fit.variable)}, inline=True)}"


def _terms(fit: Fit) -> dict[str, FittedTermAnswer]:
    if fit.variable is None or fit.variable.partition is None:
        return {}
    parts, fitted = fit.variable.partition, {}
    for (name, term), centre, error, largest in zip(
        fit.variable.terms.items(), parts.centres, parts.squared_errors, parts.largest_errors, strict=True
    ):
        assert isinstance(term, TwoTermGaussian)
        bumps = tuple((bump.height, bump.centre, bump.width) for bump in (term.first, term.second))
        fitted[name] = FittedTermAnswer(
            centre=centre,
            squared_error=error,
            largest_error=largest,
            form="held" if name in parts.held else "free",
            because=parts.held.get(name),
            two_term_gaussian=bumps,
        )
    return fitted


def _runs(fit: Fit) -> Iterator[tuple[str, int, str]]:
    """Neighbouring radii with the same number of clusters in one row."""
    for count, run in groupby(fit.counts, key=lambda radius: fit.counts[radius]):
        radii = list(run)
        ends = f"{radii[0]:g}" if len(radii) == 1 else f"{radii[0]:g}..{radii[-1]:g}"
        yield ends, count, f"radius {fit.radius:g} is used" if fit.radius in radii else ""
