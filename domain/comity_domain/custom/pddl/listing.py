"""Lists of names with types, `a b - room c`, and what is made of them: predicates and functions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from comity_domain.custom.pddl.declared import OBJECT, Signature, Typed
from comity_domain.custom.pddl.form import Form, Item, Word, complaint
from comity_domain.custom.pddl.names import each_once, name_of


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
