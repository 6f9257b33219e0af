"""Every start of every action is in the trace: counted where the actions begin, and read from the trace."""

from __future__ import annotations

from collections import Counter

import pytest
from fault_study import place_of, played, schedule

from comity.episode import Episode
from comity_executor.nodes.leaf import Action


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often every action was started, by its name."""
    started: Counter[str] = Counter()
    initialise = Action.initialise

    def counted(action: Action) -> None:
        started[action.name] += 1
        initialise(action)

    monkeypatch.setattr(Action, "initialise", counted)
    return started


def told(episode: Episode) -> Counter[str]:
    """How often the trace says that an action began: it runs, or ends without having run before."""
    started: Counter[str] = Counter()
    before: dict[int, str] = {}
    for event in episode.events:
        ended = event.status in ("success", "failure")
        if event.status == "running" or (ended and before.get(event.path) != "running"):
            started[event.node] += 1
        before[event.path] = event.status
    actions = {node.name for node in episode.history.nodes if node.kind == "action"}
    return Counter({name: count for name, count in started.items() if name in actions})


@pytest.mark.parametrize("seed", [6, 27])
def test_every_start_of_every_action_is_told(begun: Counter[str], seed: int) -> None:
    """Also where things go wrong: with seed 6 an utterance fails three times as soon as it begins."""
    there = place_of(seed)
    faults = schedule(seed, there)
    begun.clear()
    episode = played(there, faults, seed)
    assert told(episode) == begun
    assert begun.total() > 5
