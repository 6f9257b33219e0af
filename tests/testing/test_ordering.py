"""A failure in the order of visits says what decided the order, and nothing else."""

from __future__ import annotations

import re

from tests.testing.conftest import in_a_group


def because(verdict) -> str:
    (failure,) = verdict.failures
    return "\n".join(failure.finding.because)


def far_host(room: str) -> str:
    return room.replace("2.6, 4.8", "7.4, 4.8")


def test_costs_of_the_other_order_are_told_by_their_parts(judge):
    (verdict,) = judge("visits in this order: guest, host")
    told = because(verdict)
    (extra, parts) = re.search(r"^order     guest, host would cost (\d+) cm more: (.*)$", told, re.M).groups()
    assert sum(int(part) for part in re.findall(r"[+-]\d+", parts)) == int(extra)
    assert "goes by   conversational_distance of guest" in told
    assert "desirability" not in told, "the sides of a visit are no reason for the order"
    assert "goal " not in told


def test_a_deadline_that_decides_is_named_with_its_line(judge):
    (verdict,) = judge(
        "visits in this order: host, guest",
        room=lambda room: far_host(room).replace("greet: guest", "{greet: guest, by_s: 22}"),
    )
    told = because(verdict)
    assert re.search(
        r"order     host, guest would cost \d+ cm \w+, and break a deadline: "
        r"guest would be greeted at [\d.]+ s, later than 22 s\n"
        r"goal      guest has `by_s: 22` \(.*room.scenario.yaml:11\)",
        told,
    ), told


def test_a_priority_that_decides_is_named_with_its_line(judge):
    (verdict,) = judge(
        "visits in this order: host, guest",
        room=lambda room: room.replace("greet: guest", "{greet: guest, priority: 30}"),
    )
    told = because(verdict)
    assert "+3000 because others are greeted before" in told
    assert re.search(r"goal      guest has `priority: 30` \(.*room.scenario.yaml:11\)", told)


def test_a_later_plan_that_turned_the_order_round_is_told_and_not_the_first_one(judge):
    goes = "changes:\n  - {at_s: 0.5, person: host, moves_to_m: [7.4, 4.8], facing_deg: 180}\n"
    (verdict,) = judge("visits in this order: host, guest", more=goes)
    told = because(verdict)
    assert re.search(r"plan_holds\? replanned\nreading   host moved by [\d.]+ m\n", told)
    assert "step      in the order guest, host" in told
    assert "order     " not in told, "the first plan had the order that was expected"


def test_whoever_could_not_be_served_at_first_is_visited_later_for_that_reason(judge):
    fault = "faults: [{at_s: 0.5, fault: leaf raises, leaf: Navigate_to_user(host), times: 2}]\n"
    (verdict,) = judge("visits in this order: host, guest", more=fault)
    told = because(verdict)
    assert re.search(r"reading   host was not served: .*Navigate_to_user\(host\) raises", told)
    assert "order     " not in told


def test_who_is_never_visited_has_their_own_reason_alone(judge):
    walled = (
        "furniture: [{name: fence, box_m: [5.4, 0.0, 0.1, 2.6]}, {name: gate, box_m: [5.4, 2.5, 2.6, 0.1]}]"
    )
    (verdict,) = judge(
        "visits in this order: host, guest",
        "outcome is partial",
        room=lambda room: room.replace("height_m: 6.0", f"height_m: 6.0, {walled}"),
    )
    told = because(verdict)
    assert re.fullmatch(r"plan      no free and reachable place before guest: .*", told)


def test_who_is_greeted_with_others_is_told_to_be_and_what_it_would_cost_to_come_to_each(judge):
    (verdict,) = judge("visits in this order: host, guest, sam", room=in_a_group)
    told = because(verdict)
    assert re.search(r"order     .*would cost \d+ cm more", told)
    assert re.search(r"visit     (sam|guest) is greeted with (sam|guest), before whom", told)
