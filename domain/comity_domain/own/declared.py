"""What a domain declares: types, constants, predicates, functions, actions; each with its place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from comity_domain.own.form import Form, Item, Word, complaint
from comity_fis.errors import InputError, closest

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


def typed_list(items: Sequence[Item], what: str, *, variables: bool) -> tuple[Typed, ...]:
    """Names or variables, each group of them with its type: `a b - room c`."""
    found: list[Typed] = []
    group: list[Word] = []
    position = 0
    while position < len(items):
        item = items[position]
        if isinstance(item, Word) and item.text == "-":
            type_word = _type_word(items, position)
            if not group:
                raise complaint(item.where, f"{what} before the type", f"'- {type_word}'", "Name it first.")
            found += [Typed(word, type_word.text, type_word) for word in group]
            group, position = [], position + 2
            continue
        group.append(_listed(item, what, variables=variables))
        position += 1
    return (*found, *(Typed(word, OBJECT, None) for word in group))


def _listed(item: Item, what: str, *, variables: bool) -> Word:
    right = f"{what} such as {'?x' if variables else 'x'}"
    if isinstance(item, Word) and (item.is_variable if variables else item.is_name):
        return item
    remedy = "Write a question mark before it." if variables else "Write a plain name."
    raise complaint(item.where, right, f"'{item}'", remedy)


def _type_word(items: Sequence[Item], dash: int) -> Word:
    if dash + 1 == len(items):
        where = items[dash].where
        raise complaint(where, "a type after '-'", "nothing", "Name the type, or remove the '-'.")
    item = items[dash + 1]
    if isinstance(item, Form):
        if item.head == "either":
            names = " ".join(map(str, item.rest))
            raise complaint(
                item.where,
                "one type",
                f"'{item}'",
                f"Declare a type above them, (:types {names} - thing), and write '- thing' here.",
            )
        raise complaint(item.where, "one type", f"'{item}'", "Write '- TYPE', without brackets.")
    if not item.is_name:
        raise complaint(item.where, "a type after '-'", f"'{item}'", "Name a type.")
    return item


MOST_NAMES = 3_000
"""Objects, or types, or actions: unified-planning looks each new one up among all others."""


def each_once(words: Iterable[Word], what: str) -> None:
    """Refuse a name that is declared twice, and more names than can be read in seconds.

    Raises:
        InputError: at the second one, or the first one too many.
    """
    seen: dict[str, Word] = {}
    for word in words:
        if len(seen) == MOST_NAMES:
            raise complaint(
                word.where, f"at most {MOST_NAMES} {what}s", "more", "Leave out what no plan needs."
            )
        if word.text in seen:
            first = seen[word.text].where.line
            raise complaint(
                word.where,
                f"each {what} once",
                f"'{word}' again (first in line {first})",
                "Remove or rename one of them.",
            )
        seen[word.text] = word


def sections(
    form: Form, kind: str, known: Sequence[str], several: Sequence[str] = ()
) -> dict[str, list[Form]]:
    """The parts of a `(define (kind NAME) ...)` by their keyword.

    Raises:
        InputError: for one that is unknown, or that stands there twice.
    """
    found: dict[str, list[Form]] = {}
    for item in form.items[2:]:
        if not isinstance(item, Form) or not item.head.startswith(":"):
            raise complaint(
                item.where,
                f"a section of a {kind} such as ({known[-1]} ...)",
                f"'{item}'",
                "Check the brackets before this place.",
            )
        if item.head not in known:
            raise _unknown_section(item, kind, known)
        if item.head in found and item.head not in several:
            raise complaint(item.where, f"one {item.head}", "a second one", "Join the two sections.")
        found.setdefault(item.head, []).append(item)
    return found


_WITHOUT = {
    ":derived": "Derived predicates cannot be read: write the condition out where it is used.",
    ":constraints": "Trajectory constraints cannot be read: put them into preconditions and goals.",
    ":process": "Processes cannot be read: use durative actions.",
    ":event": "Events cannot be read: use actions.",
    ":htn": "Hierarchical problems cannot be read: state a goal.",
    ":task": "Hierarchical domains cannot be read: use plain actions.",
    ":method": "Hierarchical domains cannot be read: use plain actions.",
    ":length": "Leave it out: it has no effect.",
}


def _unknown_section(item: Form, kind: str, known: Sequence[str]) -> InputError:
    other = "problem" if kind == "domain" else "domain"
    elsewhere = {":objects", ":init", ":goal", ":metric"} if kind == "domain" else {
        ":types", ":constants", ":predicates", ":functions", ":action", ":durative-action"
    }  # fmt: skip
    remedy = _WITHOUT.get(item.head) or (
        f"It belongs into the {other} file." if item.head in elsewhere else closest(item.head, known)
    )
    return complaint(item.where, f"a section of a {kind}", f"'{item.head}'", remedy)


def signatures(form: Form | None, what: str) -> Iterator[Signature]:
    """The predicates or functions of a section; a function's `- number` is skipped."""
    items = form.rest if form else ()
    position = 0
    while position < len(items):
        item = items[position]
        position += 1
        if isinstance(item, Word) and item.text == "-" and what == "function":
            following = items[position] if position < len(items) else item
            if not isinstance(following, Word) or following.text != "number":
                raise complaint(
                    following.where,
                    "functions that are numbers",
                    f"'- {following}'",
                    "Write '- number', or use a predicate with one more argument.",
                )
            position += 1
            continue
        if not isinstance(item, Form) or not item.items:
            raise complaint(
                item.where, f"a {what} such as (name ?x - type)", f"'{item}'", "Put it into brackets."
            )
        parameters = typed_list(item.rest, "a variable", variables=True)
        each_once((typed.word for typed in parameters), "variable")
        yield Signature(name_of(item.items[0], what), parameters)


NOT_NAMES = frozenset(
    [
        "and",
        "or",
        "not",
        "imply",
        "exists",
        "forall",
        "when",
        "either",
        "assign",
        "increase",
        "decrease",
        "scale-up",
        "scale-down",
        "define",
        "preference",
    ]
)
"""Words of the language itself, which no predicate, function or action may bear."""


def name_of(item: Item, what: str) -> Word:
    """A word that can name something.

    Raises:
        InputError: if it is none.
    """
    if isinstance(item, Word) and item.is_name and (item.text not in NOT_NAMES):
        return item
    raise complaint(
        item.where, f"the name of a {what}", f"'{item}'", "Use a plain word that PDDL does not use."
    )
