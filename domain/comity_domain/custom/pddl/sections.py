"""The sections of a domain file and a problem file."""

from __future__ import annotations

from collections.abc import Sequence

from comity_domain.custom.pddl.form import Form, complaint
from comity_fis.errors import InputError, closest


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
