"""The part of a visit's tree before a person who does not see: words for what they cannot watch.

    Announced(u) ->
    |- coming_told(u) ?             said before the robot is nearer than 1.5 m
    |  |- <> coming_told?(u)
    |  '- Tell_coming(u) ->(memory)    Come_near, Timeout > Say_coming
    '- Reach_user ->(memory)

    Docked_and_told(u) ->
    |- docked(u) ?                  as before anybody
    '- stop_told(u) ?
       |- <> stop_told?(u)
       '- Tell_stopped(u) =>           Keep_distance, Timeout > Say_stopped

Whoever the robot goes to next, or whatever it fetches, comes after

    leave_told(v) ?
    |- <> leave_told?(v)
    |- Timeout > Say_leaving(v)
    '- Leave_untold(v)              SUCCESS: a robot without a voice does not stand there for ever
"""

from __future__ import annotations

from collections.abc import Mapping

from py_trees.behaviour import Behaviour

from comity_executor.leaves.announce import (
    Announcement,
    ComeNear,
    IsComingTold,
    IsLeaveTold,
    IsStopTold,
    LeaveUntold,
    SayComing,
    SayLeaving,
    SayStopped,
)
from comity_executor.leaves.keep_distance import KeepDistance
from comity_executor.memory.visit_context import VisitContext
from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.cause import Provenance
from comity_executor.nodes.composites import fallback, parallel_until_one, sequence
from comity_executor.nodes.identity import NodeId
from comity_fis.inference.value import Inference


def coming_told(meeting: VisitContext, reach: Behaviour) -> Behaviour:
    """The way to a person, after they were told that the robot comes.

    Args:
        meeting: Who it is.
        reach: Going to them.
    """
    person = meeting.person
    tell = sequence(
        NodeId.of("Tell_coming", person),
        [ComeNear(meeting), _in_time(meeting, SayComing(meeting))],
        memory=True,
    )
    told = fallback(NodeId.of("coming_told", person), [IsComingTold(meeting), tell])
    return sequence(NodeId.of("Announced", person), [told, reach])


def stop_told(meeting: VisitContext, docked: Behaviour) -> Behaviour:
    """Being docked, and the person knows.

    Args:
        meeting: Who it is.
        docked: The precondition of being docked.
    """
    person = meeting.person
    tell = parallel_until_one(  # Keep_distance never ends by itself
        NodeId.of("Tell_stopped", person),
        [KeepDistance(meeting), _in_time(meeting, SayStopped(meeting))],
    )
    told = fallback(NodeId.of("stop_told", person), [IsStopTold(meeting), tell])
    return sequence(NodeId.of("Docked_and_told", person), [docked, told])


def leave_told(
    meeting: VisitContext,
    about: tuple[str, ...],
    provenance: Provenance,
    values: Mapping[str, Inference],
    *,
    goes_to: str | None,
) -> Behaviour:
    """Before the robot goes: a person who does not see and is left is told so.

    Args:
        meeting: Whose branch it is in.
        about: What the nodes' names have in brackets.
        provenance: The step for which the robot leaves.
        values: Everyone's parameters, by name.
        goes_to: The person whom it goes to; None: it goes to a place.
    """
    limits = meeting.limits
    say = ActTimeout(
        NodeId(f"Timeout {limits.act_timeout_s:g} s", ("Say_leaving", *about), meeting.person),
        SayLeaving(meeting, about, provenance, values),
        duration_s=limits.act_timeout_s,
        pause_s=limits.act_pause_s,
        clock=meeting.senses.now_s,
        provenance=provenance,
    )
    asked = IsLeaveTold(meeting, about, provenance, goes_to=goes_to)
    children = [asked, say, LeaveUntold(meeting, about, provenance)]
    return fallback(NodeId("leave_told", about, meeting.person), children)


def _in_time(meeting: VisitContext, act: Announcement) -> Behaviour:
    limits = meeting.limits
    patience_s = limits.act_timeout_s / min(1.0, meeting.manner.rate)  # slow speech takes its time
    return ActTimeout(
        NodeId.of(f"Timeout {patience_s:g} s", act.verb, meeting.person),
        act,
        duration_s=patience_s,
        pause_s=limits.act_pause_s,
        clock=meeting.senses.now_s,
        provenance=meeting.reach_grounds,
    )
