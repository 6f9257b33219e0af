"""Who is in which group and meets the conditions in which order: drawn by a seed, in blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from comity.output.csv_text import csv_text
from comity.study.latin_square import balanced_orders
from comity_fis.errors import WrongValueError

GROUPS, ORDERS = 1, 2
"""Streams of random numbers: another number of conditions leaves the groups as they are."""


@dataclass(frozen=True, slots=True)
class Session:
    """One participant's session."""

    participant: str
    """A code such as `P07`."""
    group: str
    """Empty where there is only one."""
    block: int
    """From 1; the groups are equally large in each block."""
    conditions: tuple[str, ...]
    """In the order in which the participant meets them."""


def allocated(
    participants: int,
    conditions: Sequence[str],
    groups: Sequence[str] = (),
    *,
    block: int | None = None,
    seed: int,
) -> tuple[Session, ...]:
    """Sessions in the order of arrival.

    Groups are drawn in permuted blocks (Pocock 1983, Clinical Trials, chapter 5), so that they stay of about
    one size whenever the study ends. In each group the orders of a balanced Latin square come equally often,
    in a drawn order. More participants change nothing for those before them.

    Args:
        participants: How many, from 1 up.
        conditions: What each meets, each once.
        groups: Between which participants are divided; none for one group.
        block: Participants in a block, a multiple of the number of groups; twice that number without it.
        seed: Of all that is drawn.

    Raises:
        WrongValueError: for a block that the groups do not divide, or a name twice.
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
        session: The participant's.
        study: What the study is called.
        trials: Stop distances to write down for each condition.
    """
    lines = [f"{study}: participant {session.participant}", ""]
    lines += [f"Group: {session.group}"] if session.group else []
    lines += ["Date: ____________   Experimenter: ____________   Consent given: [ ]", ""]
    for place, condition in enumerate(session.conditions, 1):
        lines += [f"{place}. {condition}", ""]
        lines += [f"   Trial {i}: stop distance ________ cm" for i in range(1, trials + 1)]
        lines += ["   Notes: ______________________________________________", ""]
    return "\n".join(lines)
