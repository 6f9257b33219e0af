"""User-given names in a run, with their pseudonyms."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any, TypeVar

from comity.scenario import MapPlace, Scenario
from comity.sharing.person import pseudonyms
from comity.specification.goals import Goal
from comity_domain.plans.actions import FETCH, GREET, GREET_TOGETHER, REACH, RETURN, TASKS
from comity_executor import NodeId
from comity_fis.record import Record
from comity_sim2d.maps.file import MapFile

if TYPE_CHECKING:
    from comity_executor import Cause, Node

Told = TypeVar("Told", bound=Record)

# fmt: off
PROGRAM = frozenset({
    REACH, RETURN, GREET, GREET_TOGETHER, FETCH, *TASKS, *map(str.lower, TASKS), "Skip_visit",
    "nod", "wave", "bow", "bow_and_nod", "handshake", "palms_together", "pick_up", "hand_over",
    "front", "left", "right", "behind", "start", "here", "none",
    "verbal", "gestural", "both", "speaks", "moves", "robot",
})
"""Comity's own words that occur among names."""
IDENTIFIERS = frozenset({
    "person", "arguments", "people", "parameters", "other_parameters", "parameter", "value",
    "thing", "together_with", "node", "door", "planned", "inferred", "about", "already",
})
"""Fields of answers with names or words of a closed vocabulary."""
KEPT = frozenset({
    "act", "greeting", "action", "status", "outcome", "origin", "kind", "unit", "engine", "halt", "noticed",
    "fingerprint", "files", "trace_sha256", "interrupted_by",
})
"""Fields with program words only, never names."""
# fmt: on
NUMBERED = re.compile(r"[0-9.]+( [a-z/]+)?|passer-by [0-9]+")
"""Quantities such as `3 s` or `0.8 m`, and people without a name."""
STEP = re.compile(r"(?:no longer |instead )?[A-Z][A-Za-z_]*\(.*\)")
ORDER = "in the order "
"""Text before the people of another plan."""
PLACED = frozenset({"arguments", "from_"})
"""Positional fields: an omitted name leaves an empty word."""
EMPTIED = frozenset({"parts", "unmet", "notes", "wordings"})
"""Prose fields about a person's origin, languages or obstacles, which are emptied."""
KEPT_CAUSES = frozenset({"step", "parameter", "reading", "condition"})
"""Causes that are kept without their text; rules, variables and sources reveal culture and gender."""


@dataclass(frozen=True, slots=True)
class RunNames:
    """Names in a run; any word that is neither a known name nor a program word is removed."""

    given: Mapping[str, str]
    """Pseudonyms by name."""
    words: Collection[str]
    """Words of the rulebook (parameters and their values) and of the tree (actions)."""
    nodes: Mapping[str, str] = field(default_factory=dict)
    """Pseudonymous names of nodes, by name."""

    def word(self, word: str) -> str:
        """The pseudonym of a name, a program or rulebook word unchanged, or else an empty string."""
        if word in self.given:
            return self.given[word]
        return word if word in PROGRAM or word in self.words or NUMBERED.fullmatch(word) else ""

    def node(self, node: Node) -> Node:
        """A node of the tree with its action unchanged and its arguments pseudonymised."""
        person = None if node.person is None else self.word(node.person)
        renamed = replace(node, about=tuple(map(self.word, node.about)), person=person)
        return replace(renamed, name=NodeId(renamed.action, renamed.about, person).name)

    def with_nodes(self, nodes: Iterable[Node]) -> RunNames:
        """A copy that also knows the node names of a trace."""
        return replace(self, nodes={node.name: self.node(node).name for node in nodes})

    def _step_text(self, text: str) -> str:
        """A pseudonymised step of a plan, such as `Reach_user(robot, johanna, left)`."""
        head, bracket, inside = text.partition("(")
        for name in sorted(self.given, key=len, reverse=True):
            inside = re.sub(
                rf"(^|(?<=, )|(?<=\()){re.escape(name)}(?=[,)])", f"\0{self.given[name]}\0", inside
            )
        parts = re.split(r"(\0[^\0]*\0|, |[()])", inside)
        return head + bracket + "".join(self._part(part) for part in parts if part)

    def _part(self, part: str) -> str:
        if part.startswith("\0"):
            return part.strip("\0")
        return part if part in {", ", "(", ")"} else self.word(part)

    def answer(self, answer: Told) -> Told:
        """An answer with numbers, pseudonyms and closed vocabularies; all prose is emptied."""
        named = {field.name: getattr(answer, field.name) for field in fields(answer)}
        return replace(answer, **{name: self._value(name, value) for name, value in named.items()})

    def _value(self, field: str, value: Any) -> Any:
        told: Any
        match value:
            case None | bool() | int() | float():
                told = value
            case Record():
                told = self.answer(value)
            case str():
                told = self._word(field, value)
            case tuple() | dict() if field in EMPTIED:
                told = ()
            case tuple() if field in PLACED:
                told = tuple(map(self.word, value))
            case tuple():
                told = tuple(one for each in value if (one := self._value(field, each)) != "")
            case Mapping():
                told = {self.given.get(key, key): self._value(field, one) for key, one in value.items()}
            case _:
                told = None  # a date
        return told

    def _word(self, field: str, value: str) -> str:
        if field in KEPT:
            return value
        if field == "node":
            return self.nodes.get(value, "")
        return self.word(value) if field in IDENTIFIERS else ""

    def cause(self, cause: Cause) -> Cause | None:
        """A cause with its number but no text; None if it names a fact or a rule."""
        from comity_executor import Cause

        if cause.kind not in KEPT_CAUSES:
            return None
        value = self.word(cause.value) if isinstance(cause.value, str) else cause.value
        if cause.kind == "step":
            return Cause(cause.kind, self._step(cause.text), value)
        name = cause.text.split(" ", 1)[0] if cause.kind == "parameter" else cause.kind
        shown = f"{value:.2f}" if isinstance(value, float) else value or ""
        return Cause(cause.kind, f"{self.word(name) or cause.kind} {shown}".strip(), value)

    def _step(self, text: str) -> str:
        """A pseudonymised step of a plan, or what another plan does with it."""
        if STEP.fullmatch(text):
            return self._step_text(text)
        _, order, people = text.partition(ORDER)
        return ORDER + ", ".join(map(self.word, people.split(", "))) if order else "step"


def names_in(scenario: Scenario, words: Collection[str]) -> RunNames:
    """All names of a resolved scenario.

    Args:
        scenario: The resolved scenario.
        words: Parameters of the rulebook and their values.
    """
    given: dict[str, str] = {}
    for kind, names in (*_of_place(scenario), *_of_goals(scenario)):
        given |= pseudonyms((name for name in names if name not in given), kind)
    given |= pseudonyms(scenario.groups, "group") | {scenario.robot.name: "robot"}
    return RunNames(given | pseudonyms(scenario.people), words)


def _of_place(scenario: Scenario) -> Iterator[tuple[str, Collection[str]]]:
    place = scenario.place
    if isinstance(place, MapPlace) and isinstance(place.map, MapFile):
        yield "room", place.map.rooms
        yield "door", place.map.doors
        yield "place", place.map.locations
        yield "furniture", [piece.name for piece in place.map.furniture]
    elif not isinstance(place, MapPlace):
        yield "furniture", [piece.name for piece in place.furniture]


def _of_goals(scenario: Scenario) -> Iterator[tuple[str, Collection[str]]]:
    carried = [scenario.robot.carrying, *(person.carrying for person in scenario.people.values())]
    yield "thing", [name for name in (*carried, *(goal.named("thing") for goal in scenario.goals)) if name]
    yield "text", [name for goal in scenario.goals if (name := goal.named("text"))]


def goal_of(goal: Goal, names: RunNames) -> dict[str, Any]:
    """A goal with pseudonyms."""
    told = goal.model_dump(mode="json", by_alias=True, exclude_none=True)
    return {
        key: names.word(value) if isinstance(value, str) and key != "until" else value
        for key, value in told.items()
    }
