"""The planning problem of a scenario as PDDL files, for other planners and for readers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from comity.system.own_files import make_folder, refuse_foreign, write_whole
from comity_domain import plan_pddl

if TYPE_CHECKING:
    from comity.preparation import PlannedEpisode

DOMAIN, PROBLEM = "domain.pddl", "problem.pddl"


def write_pddl(prepared: PlannedEpisode, folder: Path) -> None:
    """Write `domain.pddl` and `problem.pddl`, readable only by the user, as they contain data about people.

    Raises:
        InputError: The folder cannot be used, or has files of these names that Comity did not write.
    """
    domain, problem = plan_pddl(prepared.asked.request)
    write_texts(domain, "".join(f"; {line}\n" for line in _not_stated(prepared)) + problem, folder)


def _not_stated(prepared: PlannedEpisode) -> Iterator[str]:
    """Features of a scenario that the problem omits."""
    for person, reason in prepared.asked.unreachable.items():
        yield f"not stated below: no plan can serve {person!a} ({ascii(reason)[1:-1]})"
    for fact in prepared.file.scenario.already:
        yield f"not stated below: {fact.greeted!a} was greeted already"
    if prepared.happenings:
        first_s = min(happening.at_s for happening in prepared.happenings)
        yield f"not stated below: what happens on the way, from {first_s:g} s on; the robot replans then"


def write_texts(domain: str, problem: str, folder: Path) -> None:
    """Write PDDL that is already text, as `write_pddl`.

    Raises:
        InputError: As for `write_pddl`.
    """
    texts = {folder / DOMAIN: _OURS + domain, folder / PROBLEM: _OURS + problem}
    make_folder(folder, private=True)
    refuse_foreign(dict.fromkeys(texts, _OURS.encode()))
    for path, text in texts.items():
        write_whole(path, text.encode(), private=True)


_OURS = "; Written by Comity.\n"
