"""A unified-planning environment that loads its engines at first use: models and plans need none.

`Environment()` of unified-planning 1.3 imports all engines for its factory, which takes a second, before the
first fluent can be created.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from unified_planning.environment import Environment
from unified_planning.model import ExpressionManager, FreeVarsOracle
from unified_planning.model.type_manager import TypeManager
from unified_planning.model.walkers import (
    FreeVarsExtractor,
    NamesExtractor,
    Simplifier,
    Substituter,
    TypeChecker,
)

if TYPE_CHECKING:
    from unified_planning.engines import Factory


class LightEnvironment(Environment):  # type: ignore[misc]
    """Like `Environment`, but creates the factory on demand."""

    def __init__(self) -> None:
        self._type_manager = TypeManager()
        self._factory: Factory | None = None
        self._tc = TypeChecker(self)
        self._expression_manager = ExpressionManager(self)
        self._free_vars_oracle = FreeVarsOracle()
        self._simplifier = Simplifier(self)
        self._substituter = Substituter(self)
        self._free_vars_extractor = FreeVarsExtractor()
        self._names_extractor = NamesExtractor()
        self._credits_stream = None
        self._error_used_name = True

    @property
    def factory(self) -> Factory:
        """The installed engines."""
        if self._factory is None:
            from unified_planning.engines import Factory

            self._factory = Factory(self)
        return self._factory
