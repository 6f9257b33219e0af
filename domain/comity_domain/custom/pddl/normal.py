"""The same domain and problem in the narrow form that unified-planning's reader takes.

It wants lower case, sections and parts in one order, and no name twice among types, objects, predicates and
actions. One word stands in each line, so that whatever it complains about can be traced to a place.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from comity_domain.custom.pddl.declared import OBJECT, Action, Declared, Signature, Typed
from comity_domain.custom.pddl.document import Stated
from comity_domain.custom.pddl.effects import TOTAL_COST
from comity_domain.custom.pddl.form import Form, Item, Word
from comity_domain.custom.pddl.listing import typed_list
from comity_fis.errors import Where


@dataclass(frozen=True, slots=True)
class Renaming:
    """What words of the files are called in the problem, where they cannot keep their names."""

    types: Mapping[str, str]
    objects: Mapping[str, str]
    actions: Mapping[str, str]


def renaming(domain: Declared, problem: Stated) -> Renaming:
    """New names for what shares one: unified-planning lets no two things bear the same.

    Predicates and functions keep theirs.
    """
    taken = {*domain.predicates, *domain.functions, OBJECT, domain.name.text}
    objects = [typed.word.text for typed in (*domain.constants, *problem.objects)]
    types = [word for word in domain.parents() if word != OBJECT]
    actions = [action.word.text for action in domain.actions]
    everything = {*taken, *objects, *types, *actions}

    def settle(names: Iterable[str], kind: str) -> dict[str, str]:
        changed = {}
        for name in names:
            new, count = name, 1
            while new in taken or (new != name and new in everything):
                new, count = f"{name}_{kind}{count if count > 1 else ''}", count + 1
            taken.add(new)
            if new != name:
                changed[name] = new
        return changed

    return Renaming(settle(types, "type"), settle(objects, "object"), settle(actions, "action"))


@dataclass(slots=True)
class Text:
    """A text that grows by a line for each word and knows where each came from."""

    names: Renaming
    with_object: bool = False
    """Whether `object` is declared like any other type: the reader misses it in objects and quantifiers."""
    lines: list[str] = field(default_factory=list)
    origins: list[Where] = field(default_factory=list)

    def __str__(self) -> str:
        return "\n".join(self.lines) + "\n"

    def say(self, text: str, where: Where) -> None:
        """Add a word."""
        self.lines.append(text)
        self.origins.append(where)

    def origin(self, line: int) -> Where:
        """Where a line, counted from 1, came from."""
        return self.origins[min(max(line, 1), len(self.origins)) - 1]

    def section(self, keyword: str, where: Where, words: Iterator[tuple[str, Where]]) -> None:
        """Add a section, unless it would be empty."""
        inside = list(words)
        if inside:
            for text, place in [("(", where), (keyword, where), *inside, (")", where)]:
                self.say(text, place)

    def typed(self, several: Sequence[Typed], names: Mapping[str, str]) -> Iterator[tuple[str, Where]]:
        """Each name with its type."""
        for typed in several:
            yield names.get(typed.word.text, typed.word.text), typed.word.where
            if typed.type != OBJECT or typed.type_word:
                where = typed.type_word.where if typed.type_word else typed.word.where
                yield "-", where
                yield self.names.types.get(typed.type, typed.type), where

    def types(self, domain: Declared) -> Iterator[tuple[str, Where]]:
        """The types, each below another."""
        if not self.with_object:
            yield from self.typed(domain.types, self.names.types)
            return
        for name, above in domain.parents().items():
            for word in (self.names.types.get(name, name), "-", self.names.types.get(above, above)):
                yield word, domain.name.where
        yield (
            OBJECT,
            domain.name.where,
        )  # last: before another name, the reader puts that beside it, not below

    def signatures(self, several: Iterable[Signature], end: str = "") -> Iterator[tuple[str, Where]]:
        """Predicates, or functions with `- number`."""
        for signature in several:
            where = signature.word.where
            yield "(", where
            yield signature.word.text, where
            yield from self.typed(signature.parameters, {})
            yield f"){end}", where

    def item(self, item: Item, head: bool = True) -> Iterator[tuple[str, Where]]:
        """An expression; objects in it by their new names."""
        if isinstance(item, Word):
            is_object = not head and item.is_name
            yield self.names.objects.get(item.text, item.text) if is_object else item.text, item.where
            return
        yield "(", item.where
        if item.head in ("forall", "exists"):
            yield from self.quantified(item)
        else:
            for i, part in enumerate(item.items):
                yield from self.item(part, head=i == 0)
        yield ")", item.where

    def quantified(self, form: Form) -> Iterator[tuple[str, Where]]:
        """A quantifier, whose variables have types that may be renamed."""
        yield form.head, form.where
        yield "(", form.where
        dashed = False
        for item in form.items[1].items if isinstance(form.items[1], Form) else ():
            text = str(item).lower()
            yield self.names.types.get(text, text) if dashed else text, item.where
            dashed = text == "-"
        yield ")", form.where
        yield from self.item(form.items[2])

    def action(self, action: Action) -> Iterator[tuple[str, Where]]:
        """An action, its parts in order."""
        yield self.names.actions.get(action.word.text, action.word.text), action.word.where
        yield ":parameters", action.word.where
        yield "(", action.word.where
        yield from self.typed(action.parameters, {})
        yield ")", action.word.where
        for part in (":precondition", ":duration", ":condition", ":effect"):
            if part in action.parts:
                yield part, action.parts[part].where
                yield from self.item(action.parts[part])
            elif part == ":effect" and action.durative:
                yield from ((word, action.word.where) for word in (":effect", "(", "and", ")"))


def domain_text(domain: Declared, names: Renaming, *, with_object: bool) -> Text:
    """The domain.

    Args:
        domain: What it declares.
        names: What changes its name.
        with_object: As in `Text`.
    """
    text, top = Text(names, with_object), domain.name.where
    for word in ("(define", "(domain", domain.name.text, ")"):
        text.say(word, top)
    text.section(":requirements", top, ((word.text, word.where) for word in domain.requirements))
    text.section(":types", top, text.types(domain))
    text.section(":constants", top, text.typed(domain.constants, names.objects))
    text.section(":predicates", top, text.signatures(domain.predicates.values()))
    text.section(":functions", top, text.signatures(domain.functions.values(), end=" - number"))
    for action in domain.actions:
        keyword = ":durative-action" if action.durative else ":action"
        text.section(keyword, action.word.where, text.action(action))
    text.say(")", top)
    return text


def quantifies_objects(items: Iterable[Item]) -> bool:
    """Whether a quantifier in an expression ranges over things of all types."""
    return any(
        isinstance(item, Form) and (_over_objects(item) or quantifies_objects(item.items)) for item in items
    )


def _over_objects(form: Form) -> bool:
    if form.head not in ("forall", "exists") or not isinstance(form.items[1], Form):
        return False
    return any(typed.type == OBJECT for typed in typed_list(form.items[1].items, "", variables=True))


def problem_text(problem: Stated, names: Renaming, *, has_costs: bool) -> Text:
    """The problem.

    Args:
        problem: What it states.
        names: What changes its name.
        has_costs: Whether the domain declares `total-cost`; it then starts at 0, and is minimized where the
            problem does not say otherwise.
    """
    text, top = Text(names), problem.name.where
    for word in ("(define", "(problem", problem.name.text, ")", "(:domain", problem.domain.text, ")"):
        text.say(word, top)
    text.section(":objects", top, text.typed(problem.objects, names.objects))
    text.say("(:init", top)
    for fact in problem.init:
        for word, where in text.item(fact):
            text.say(word, where)
    if has_costs and not any(_starts_total_cost(fact) for fact in problem.init):
        text.say(f"(= ({TOTAL_COST}) 0)", top)
    text.say(")", top)
    text.section(":goal", problem.goal.where, text.item(problem.goal))
    if problem.metric:
        words = (pair for item in problem.metric for pair in text.item(item))
        text.section(":metric", problem.metric[0].where, words)
    elif has_costs:
        text.say(f"(:metric minimize ({TOTAL_COST}))", top)
    text.say(")", top)
    return text


def _starts_total_cost(fact: Form) -> bool:
    return fact.head == "=" and str(fact.items[1]).lower() in (TOTAL_COST, f"({TOTAL_COST})")
