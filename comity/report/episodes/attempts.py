"""Retried actions: those that failed or timed out, and started again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.run import AttemptsAnswer, FailedAttemptAnswer
from comity.report.episodes.why import links

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from comity_executor import Node, TraceEvent


def repeated(events: Iterable[TraceEvent], nodes: Iterable[Node]) -> Iterator[AttemptsAnswer]:
    """Retried actions, in the order of their first failures.

    Actions are identified by name, so a new plan with the same action also retries it. A preempted action, or
    one whose goal was achieved, has not failed, so a later start is no retry.

    Args:
        events: Events of the trace.
        nodes: Nodes of the trees.
    """
    actions = {node.path for node in nodes if node.kind == "action"}
    failed: dict[str, list[FailedAttemptAnswer]] = {}
    open_failures: dict[str, FailedAttemptAnswer] = {}
    for event in events:
        if event.path not in actions:
            continue
        if event.node in open_failures:
            failed.setdefault(event.node, []).append(open_failures.pop(event.node))
        if event.status == "failure" or event.halt == "timed_out":
            open_failures[event.node] = FailedAttemptAnswer(t=event.t, because=links(event.because))
    for node, failures in failed.items():
        yield AttemptsAnswer(node=node, attempts=len(failures) + 1, failed=tuple(failures))
