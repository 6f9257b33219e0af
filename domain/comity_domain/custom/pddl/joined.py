"""Conditional effects inside others as effects under one condition: unified-planning forgets the outer ones.

PDDL 2.1 has no such nesting, but Fast Downward and others take it, and so people write it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice

from comity_domain.custom.pddl.declared import Action, Declared
from comity_domain.custom.pddl.form import MAX_WORDS, Form, Item, Word, complaint

Conditions = tuple[Form, ...]


def with_joined_conditions(domain: Declared) -> Declared:
    """The domain with no `when` inside another one; it must have been checked.

    Raises:
        InputError: where an inner variable hides one of an outer condition, or it would be too long.
    """
    return replace(domain, actions=tuple(_joined(action) for action in domain.actions))


def _joined(action: Action) -> Action:
    effect = action.parts.get(":effect")
    if effect is None or not _any_nested(effect):
        return action
    written = _timed(effect) if action.durative else _effect(effect)
    if sum(1 for _ in islice(_words(written), MAX_WORDS + 1)) > MAX_WORDS:
        remedy = "State long conditions once, outside of each other."
        expected = f"at most {MAX_WORDS} words once conditions inside each other are joined"
        raise complaint(effect.where, expected, "more", remedy)
    return replace(action, parts={**action.parts, ":effect": written})


def _any_nested(form: Form, *, conditional: bool = False) -> bool:
    """Whether a `when` stands inside another one."""
    is_when = form.head == "when"
    return (is_when and conditional) or any(
        _any_nested(part, conditional=conditional or is_when) for part in _forms(form)
    )


def _timed(form: Form) -> Form:
    """`(and (at start ...) (at end ...))`."""
    if form.head == "and":
        return _with(form, [_timed(part) for part in _forms(form)])
    return replace(form, items=(*form.items[:2], *(_effect(part) for part in _forms(form))))


def _effect(form: Form) -> Form:
    """An effect that hangs on nothing outside."""
    match form.head:
        case "and":
            return _with(form, [_effect(part) for part in _forms(form)])
        case "forall":
            variables, inner = form.rest
            return replace(form, items=(form.items[0], variables, *map(_effect, _only_forms([inner]))))
        case "when" if _any_nested(form):
            return _with(form, list(_under((), form)))
    return form


def _under(outer: Conditions, form: Form) -> Iterator[Form]:
    """An effect, each of whose parts states all that it hangs on."""
    match form.head:
        case "and":
            for part in _forms(form):
                yield from _under(outer, part)
        case "when":
            condition, inner = _only_forms(form.rest)
            yield from _under((*outer, condition) if condition.items else outer, inner)
        case "forall":
            yield _for_all(outer, form)
        case _ if outer and form.items:
            condition = outer[0] if len(outer) == 1 else _with(outer[-1], outer)
            yield Form((Word("when", form.where), condition, form), form.where)
        case _:
            yield form


def _for_all(outer: Conditions, form: Form) -> Form:
    variables, inner = _only_forms(form.rest)
    bound = _variables(variables)
    for condition in outer:
        for word in _free(condition):
            if word.text in bound:
                got = f"'{word}' again, which the condition '{condition}' around it means otherwise"
                remedy = "Call the variable of the forall something else."
                raise complaint(variables.where, "a new variable", got, remedy)
    return replace(form, items=(form.items[0], variables, _with(inner, list(_under(outer, inner)))))


def _free(form: Form) -> Iterator[Word]:
    """The variables of a condition that it does not bind itself."""
    if form.head in ("forall", "exists"):
        variables, inner = _only_forms(form.rest)
        yield from (word for word in _free(inner) if word.text not in _variables(variables))
        return
    for item in form.items:
        if isinstance(item, Form):
            yield from _free(item)
        elif item.is_variable:
            yield item


def _variables(form: Form) -> frozenset[str]:
    return frozenset(word.text for word in _words(form) if word.is_variable)


def _with(form: Form, parts: Sequence[Form]) -> Form:
    """All of these, in the place of a form."""
    return Form((Word("and", form.where), *parts), form.where)


def _forms(form: Form) -> tuple[Form, ...]:
    return _only_forms(form.items)


def _only_forms(items: Sequence[Item]) -> tuple[Form, ...]:
    return tuple(item for item in items if isinstance(item, Form))


def _words(item: Item) -> Iterator[Word]:
    if isinstance(item, Word):
        yield item
    else:
        for part in item.items:
            yield from _words(part)
