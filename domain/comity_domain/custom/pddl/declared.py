"""What a domain declares: types, constants, predicates, functions, actions; each with its place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_domain.custom.pddl.form import Form, Word

OBJECT = "object"
"""PDDL's type above all types."""


@dataclass(frozen=True, slots=True)
class Typed:
    """A name or a variable with its type."""

    word: Word
    type: str
    type_word: Word | None
    """None where no type is written."""


@dataclass(frozen=True, slots=True)
class Signature:
    """A predicate or a function."""

    word: Word
    parameters: tuple[Typed, ...]


@dataclass(frozen=True, slots=True)
class Action:
    """An action with its parts as they are written."""

    word: Word
    durative: bool
    parameters: tuple[Typed, ...]
    parts: Mapping[str, Form]
    """By keyword: precondition or condition, effect, duration."""


@dataclass(frozen=True, slots=True)
class Declared:
    """A domain."""

    name: Word
    requirements: tuple[Word, ...]
    types: tuple[Typed, ...]
    constants: tuple[Typed, ...]
    predicates: Mapping[str, Signature]
    functions: Mapping[str, Signature]
    actions: tuple[Action, ...]

    def parents(self) -> Mapping[str, str]:
        """The type above each type; `object` has none."""
        above = {typed.type: OBJECT for typed in self.types if typed.type != OBJECT}
        return {**above, **{typed.word.text: typed.type for typed in self.types if typed.word.text != OBJECT}}

    def is_a(self, type_: str, above: str) -> bool:
        """Whether everything of one type is of the other, too."""
        parents = self.parents()
        while type_ != above:
            if type_ not in parents:
                return False
            type_ = parents[type_]
        return True
