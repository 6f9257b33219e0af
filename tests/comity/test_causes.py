"""Claimed causes against the world: without what the trace blames for a switch, the switch does not happen.

Every episode is run again with the same seed, up to the switch, with what is blamed held at what it was
before (`comity_executor.tracing.intervention`). Two controls show that the judge is awake.
"""

from __future__ import annotations

import random
from collections import Counter
from dataclasses import replace

import pytest

from comity_executor import History, Intervention, Switch, switches
from comity_executor.tracing.intervention import Result
from tests.comity.disturbed import SCENARIOS, Disturbed

FEW = ("johanna", "acquaintance", 1)
Case = tuple[Disturbed, History, Switch]


def cases(count: int, scenarios: tuple[str | int, ...], seeds: int) -> list[Case]:
    """So many switches, drawn from all those of the episodes of some scenarios and seeds."""
    found: list[Case] = []
    for scenario in scenarios:
        for seed in range(seeds):
            episode = Disturbed(scenario, seed)
            history = episode.run()
            found += ((episode, history, switch) for switch in switches(history))
    return random.Random(0).sample(found, count)


def still_happens(episode: Disturbed, switch: Switch, intervention: Intervention) -> bool:
    """Whether the robot does the same at the same time, in the same world with one thing held."""
    return switch.happens_in(episode.run(intervention, until_s=switch.event.t + 0.1))


@pytest.fixture(scope="module")
def few() -> list[Case]:
    return cases(16, FEW, seeds=1)


def kind(switch: Switch) -> str:
    """`say halted (preempted) by docked? -> failure`, whoever it was about."""
    event, cause = switch.event, switch.cause
    doing = "an action began" if event.status == "running" else f"an action was halted ({event.halt})"
    return f"{doing}, blamed: {cause.action} -> {cause.status}"


def judged(chosen: list[Case]) -> tuple[Counter[str], list[str]]:
    """How many switches of each kind there were, and those that happened without what was blamed."""
    wrong = [
        f"{episode} t={switch.event.t:g} {switch.event.node}: {kind(switch)}"
        for episode, _, switch in chosen
        if still_happens(episode, switch, switch.without_cause)
    ]
    return Counter(kind(switch) for _, _, switch in chosen), wrong


def test_without_what_is_blamed_a_switch_does_not_happen(few: list[Case]) -> None:
    kinds, wrong = judged(few)
    assert len(kinds) >= 4, "the sample must show switches of several kinds"
    assert len(wrong) <= 0.05 * len(few), wrong


@pytest.mark.study
def test_of_a_thousand_switches_at_least_95_percent_are_rightly_blamed() -> None:
    """The table in docs/explanation/the-trace.md; `pytest -s` prints it."""
    kinds, wrong = judged(cases(1000, SCENARIOS, seeds=5))
    print(*(f"| {kind} | {count} |" for kind, count in kinds.most_common()), sep="\n")
    print(f"{len(wrong)} of 1000 wrong", *wrong, sep="\n")
    assert len(wrong) <= 50


def test_held_in_the_tick_before_it_changes_nothing(few: list[Case]) -> None:
    """A control: there it still was what it is held at, and the world goes the same way to the tick."""
    for episode, _, switch in few[:5]:
        before = replace(switch.without_cause, t=switch.cause.t - 0.05)
        assert still_happens(episode, switch, before), switch


def bystander(history: History, switch: Switch) -> Intervention | None:
    """The last leaf that came to a result before the switch and is not blamed, held at the opposite of it.

    Only where it came to it in the tick of the switch: what came before does not happen again.
    """
    for event in reversed(history.events[: history.events.index(switch.event)]):
        leaf = history.nodes[event.path].kind in ("condition", "action")
        if event.t == switch.event.t and leaf and event.path != switch.cause.path:
            opposite: dict[str, Result] = {"success": "failure", "failure": "success"}
            return Intervention(event.path, event.t, opposite.get(event.status, "failure"))
    return None


@pytest.mark.study
def test_another_change_of_the_same_tick_is_mostly_not_what_the_switch_needs() -> None:
    """A control: the judge does not agree to whatever is blamed."""
    chosen = [
        (episode, switch, other)
        for episode, history, switch in cases(300, SCENARIOS, seeds=5)
        if (other := bystander(history, switch))
    ]
    wrong = sum(still_happens(episode, switch, other) for episode, switch, other in chosen)
    print(f"{wrong} of {len(chosen)} bystanders were not needed")
    assert wrong > 0.3 * len(chosen)
