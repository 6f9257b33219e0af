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
    """Write `domain.pddl` and `problem.pddl`, which the user alone may read: they tell of people.

    Raises:
        InputError: if the folder cannot be used, or holds files of these names that are not ours.
    """
    domain, problem = plan_pddl(prepared.asked.request)
    write_texts(domain, "".join(f"; {line}\n" for line in _not_stated(prepared)) + problem, folder)


def _not_stated(prepared: PlannedEpisode) -> Iterator[str]:
    """What of a scenario the problem leaves out, so that nobody takes it for all of it."""
    for person, reason in prepared.asked.unreachable.items():
        yield f"not stated below: no plan can serve {person!a} ({ascii(reason)[1:-1]})"
    for fact in prepared.file.scenario.already:
        yield f"not stated below: {fact.greeted!a} was greeted already"
    if prepared.happenings:
        first_s = min(happening.at_s for happening in prepared.happenings)
        yield f"not stated below: what happens on the way, from {first_s:g} s on; the robot replans then"


def write_texts(domain: str, problem: str, folder: Path) -> None:
    """The same for PDDL that is text already.

    Raises:
        InputError: as `write_pddl`.
    """
    texts = {folder / DOMAIN: _OURS + domain, folder / PROBLEM: _OURS + problem}
    make_folder(folder, private=True)
    refuse_foreign(dict.fromkeys(texts, _OURS.encode()))
    for path, text in texts.items():
        write_whole(path, text.encode(), private=True)


_OURS = "; Written by Comity.\n"
