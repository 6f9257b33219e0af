"""Allocation of participants to groups and orders of conditions: seeded, in permuted blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from comity.output.csv_text import csv_text
from comity.study.latin_square import balanced_orders
from comity_fis.errors import WrongValueError

GROUPS, ORDERS = 1, 2
"""Random streams: a different number of conditions leaves the groups unchanged."""


@dataclass(frozen=True, slots=True)
class Session:
    """One participant's session."""

    participant: str
    """A code such as `P07`."""
    group: str
    """Name of the group; empty if there is only one."""
    block: int
    """Block number, from 1; the groups are equally large in each block."""
    conditions: tuple[str, ...]
    """Conditions in the participant's order."""


def allocated(
    participants: int,
    conditions: Sequence[str],
    groups: Sequence[str] = (),
    *,
    block: int | None = None,
    seed: int,
) -> tuple[Session, ...]:
    """Sessions in the order of arrival.

    Groups are drawn in permuted blocks (Pocock 1983, Clinical Trials, chapter 5), so that their sizes stay
    similar whenever the study ends. In each group, the orders of a balanced Latin square are used equally
    often, in random order. Additional participants leave earlier ones unchanged.

    Args:
        participants: Number of participants, at least 1.
        conditions: Conditions that each participant meets, without duplicates.
        groups: Groups that participants are divided into; empty for one group.
        block: Participants per block, a multiple of the number of groups; twice that number by default.
        seed: Seed of all random draws.

    Raises:
        WrongValueError: for a block size that is no multiple of the number of groups, or a duplicate name.
    """
    names = tuple(groups) or ("",)
    size = block or 2 * len(names)
    if size % len(names):
        raise WrongValueError(
            expected=f"a block of a multiple of {len(names)}, one for each group",
            got=str(size),
            remedy=f"Take {len(names) * max(1, round(size / len(names)))}.",
        )
    for called, given in (("conditions", conditions), ("groups", names)):
        if len(set(given)) < len(given) or not given:
            raise WrongValueError(
                expected=f"{called}, each once",
                got=", ".join(given) or "none",
                remedy="Name each of them once.",
            )
    orders = balanced_orders(len(conditions))
    drawn: dict[str, list[int]] = {name: [] for name in names}
    rngs = {name: _rng(seed, ORDERS, i) for i, name in enumerate(names)}
    sessions: list[Session] = []
    places: list[int] = []
    block_of = _rng(seed, GROUPS)
    for number in range(participants):
        if number % size == 0:
            places = block_of.permutation(np.repeat(np.arange(len(names)), size // len(names))).tolist()
        group = names[places[number % size]]
        if not drawn[group]:
            drawn[group] = rngs[group].permutation(len(orders)).tolist()
        order = orders[drawn[group].pop()]
        sessions.append(
            Session(
                participant=f"P{number + 1:02d}",
                group=group,
                block=number // size + 1,
                conditions=tuple(conditions[i] for i in order),
            )
        )
    return tuple(sessions)


def _rng(*words: int) -> np.random.Generator:
    return np.random.Generator(np.random.PCG64(words))


def allocation_csv(sessions: Sequence[Session]) -> str:
    """The allocation, a row for each participant."""
    conditions = (f"condition_{i}" for i in range(1, len(sessions[0].conditions) + 1))
    rows = ((one.participant, one.group, one.block, *one.conditions) for one in sessions)
    return csv_text(("participant", "group", "block", *conditions), rows)


def sheet(session: Session, study: str, trials: int) -> str:
    """A participant's sheet to print and fill in by hand.

    Args:
        session: The participant's session.
        study: Name of the study.
        trials: Number of stop distances to write down for each condition.
    """
    lines = [f"{study}: participant {session.participant}", ""]
    lines += [f"Group: {session.group}"] if session.group else []
    lines += ["Date: ____________   Experimenter: ____________   Consent given: [ ]", ""]
    for place, condition in enumerate(session.conditions, 1):
        lines += [f"{place}. {condition}", ""]
        lines += [f"   Trial {i}: stop distance ________ cm" for i in range(1, trials + 1)]
        lines += ["   Notes: ______________________________________________", ""]
    return "\n".join(lines)
