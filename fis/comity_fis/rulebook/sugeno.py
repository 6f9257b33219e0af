"""Zero-order Sugeno systems: every output is a mean of constants, weighted by firing strength."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_fis.membership.function import Singleton
from comity_fis.variables.parameter import NumericParameter

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook


def is_sugeno(rulebook: Rulebook) -> bool:
    """Whether a rulebook is one: numeric terms are singletons, aggregated by sum, defuzzified by centroid."""
    numbers = [one for one in rulebook.parameters.values() if isinstance(one, NumericParameter)]
    terms = [term for one in numbers for term in one.conclusions.values()]
    methods = rulebook.methods
    averaged = (methods.aggregation, methods.defuzzification) == ("sum", "centroid")
    return averaged and bool(terms) and all(isinstance(term, Singleton) for term in terms)
