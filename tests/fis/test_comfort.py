"""The posterior over a person's comfort interval: its laws, then examples."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis.learning.comfort import (
    CONTRARY,
    FARTHEST,
    INVITES,
    MANNER_WEIGHTS,
    MIDDLES,
    STEP_FARTHER,
    STEP_NEARER,
    WITHIN,
    ComfortPosterior,
)
from comity_fis.learning.showing import drawn, misread, noticed, shown
from comity_fis.learning.signals import AWAY, SIGNALS

SPREAD = 0.30
OFFSETS = st.floats(-0.6, 0.6)
OBSERVATIONS = st.lists(st.tuples(st.sampled_from(SIGNALS), OFFSETS, st.integers(0, 60)), max_size=6)
few = settings(max_examples=40)


def learnt(observations) -> ComfortPosterior:
    known = ComfortPosterior.before_meeting(SPREAD)
    for signal, offset, days in observations:
        known = known.later(days).after(signal, offset)
    return known


def mean(known: ComfortPosterior) -> float:
    return float(known.weights.sum(axis=(-2, -1)) @ MIDDLES) * SPREAD


def away_from_the_prior(known: ComfortPosterior) -> float:
    """The Kullback-Leibler divergence from the prior."""
    prior, weights = ComfortPosterior.before_meeting(SPREAD).weights, known.weights
    inside = weights > 0
    return float((weights[inside] * np.log(weights[inside] / prior[inside])).sum())


def test_before_any_meeting_the_models_value_stands():
    """The interval is a little wider than the rulebook's spread makes it: the model may be wrong."""
    known = ComfortPosterior.before_meeting(SPREAD)
    assert float(known.offset) == 0.0
    assert SPREAD < float(known.deviation) < 1.2 * SPREAD
    low, high = known.interval()
    assert float(low) == pytest.approx(-float(high))
    assert 1.645 * SPREAD < float(high) < 1.9 * SPREAD


def test_who_insists_is_met_as_far_out_as_the_offset_goes():
    """And while they do, the robot allows for their meaning the opposite: the interval holds both."""
    known, stood = ComfortPosterior.before_meeting(SPREAD), []
    for _ in range(12):
        stood.append(float(known.offset))
        known = known.later(30).after("step_back", stood[-1])
    assert stood == sorted(stood)
    assert stood[-1] == pytest.approx(FARTHEST * SPREAD)
    opposite = known.weights[..., CONTRARY]
    assert opposite.sum() > MANNER_WEIGHTS[CONTRARY].sum() / 10


@given(OFFSETS, st.integers(0, 400))
def test_evidence_of_one_end_moves_the_interval_the_right_way(offset, days):
    """Too close never makes the liked distance nearer on the mean, and too far never farther."""
    known = ComfortPosterior.before_meeting(SPREAD).later(days)
    for signal in ("step_back", "ask_farther"):
        assert mean(known.after(signal, offset)) >= mean(known) - 1e-9
    for signal in ("lean_in", "ask_closer"):
        assert mean(known.after(signal, offset)) <= mean(known) + 1e-9


@few
@given(OBSERVATIONS, OFFSETS, st.sampled_from([("step_back", 1), ("lean_in", -1)]))
def test_the_same_holds_after_any_history(history, offset, evidence):
    """Among people alike in width and manner the odds of any two middles shift towards the farther one.

    Among those who show the opposite of what they feel, they shift towards the nearer one.
    """
    signal, sign = evidence
    known = learnt(history)
    before, after = known.weights, known.after(signal, offset).weights
    for half in range(before.shape[-2]):
        for manner, contrary in enumerate(CONTRARY):
            ratio = after[:, half, manner] / before[:, half, manner]
            means = -sign if contrary else sign
            assert (means * np.diff(ratio) >= -1e-9 * ratio.max()).all()


@few
@given(st.lists(OFFSETS, max_size=30))
def test_silence_never_rules_anything_out(offsets):
    """Some people never show anything: no middle falls below their share of its prior."""
    known = ComfortPosterior.before_meeting(SPREAD)
    prior = known.weights.sum(axis=(-2, -1))
    for offset in offsets:
        known = known.after("nothing", offset)
    assert (known.weights.sum(axis=(-2, -1)) >= MANNER_WEIGHTS[0] * prior * (1 - 1e-9)).all()


@given(OFFSETS, st.integers(1, 40))
def test_silence_alone_leaves_a_wide_interval(offset, times):
    """It never narrows beyond what the people who never show anything leave: tails of 1/20 of their share."""
    known = learnt([("nothing", offset, 0)] * times)
    low, high = known.interval()
    quantile = MANNER_WEIGHTS[0] * 0.05
    prior = ComfortPosterior.before_meeting(SPREAD)
    assert float(high - low) > 0.0
    # At least the share of the silent lies as the prior does beyond either end of any narrower interval.
    outside = known.weights.sum(axis=(-2, -1))[np.abs(MIDDLES * SPREAD) > 1.645 * SPREAD].sum()
    assert outside >= quantile
    assert float(known.deviation) >= math.sqrt(MANNER_WEIGHTS[0]) * float(prior.deviation) * 0.9


@few
@given(OBSERVATIONS, st.floats(0, 4000), st.floats(0, 4000))
def test_time_only_ever_leads_back_to_the_prior(history, days, more):
    """The divergence from the prior never grows with time."""
    distances = [away_from_the_prior(learnt(history).later(time)) for time in (0, days, days + more)]
    assert all(later <= earlier + 1e-9 for earlier, later in pairwise(distances))


@few
@given(OBSERVATIONS, st.floats(1, 400))
def test_what_is_known_widens_with_time(history, days):
    """Where it is much narrower than the prior: the prior has wide tails, and the drift forgets those last.

    A posterior about as wide as the prior may narrow a little before it widens.
    """
    known = learnt(history)
    if float(known.deviation) < 0.8 * float(ComfortPosterior.before_meeting(SPREAD).deviation):
        assert float(known.later(days).deviation) >= float(known.deviation) - 1e-9


@few
@given(OBSERVATIONS, st.floats(0, 400), st.floats(0, 400))
def test_time_may_pass_in_pieces(history, days, more):
    known = learnt(history)
    at_once, in_pieces = known.later(days + more), known.later(days).later(more)
    assert np.allclose(at_once.weights, in_pieces.weights, atol=1e-12)


def test_nothing_is_forgotten_faster_than_a_preference_drifts():
    """After a month what was learnt is still most of what counts; after ten years only a step is left."""
    known = learnt([("ask_farther", 0.0, 0)])
    assert float(known.later(30).offset) > 0.8 * float(known.offset)
    assert float(known.later(3650).offset) == pytest.approx(STEP_FARTHER * SPREAD)


@few
@given(OBSERVATIONS, st.tuples(st.sampled_from(sorted(AWAY)), OFFSETS), st.integers(0, 400), OBSERVATIONS)
def test_the_robot_never_comes_nearer_than_the_last_step_back_uninvited(before, away, days, after):
    """Not after any time, and not for anything else that is shown later, except an invitation."""
    uninvited = [(signal, at, time) for signal, at, time in after if signal not in INVITES]
    known = learnt(before).after(*away).later(days)
    for signal, offset, time in uninvited:
        known = known.later(time).after(signal, offset)
    assert float(known.offset) >= away[1]


@few
@given(OBSERVATIONS)
def test_the_robot_comes_nearer_than_the_model_only_when_invited(history):
    uninvited = [(signal, at, time) for signal, at, time in history if signal not in INVITES]
    assert float(learnt(uninvited).offset) >= 0.0


@few
@given(OBSERVATIONS, st.sampled_from(sorted(INVITES)), OFFSETS)
def test_one_invitation_is_one_step(history, signal, offset):
    """Given at the boundary it moves it by a step at most; given from farther out it moves nothing."""
    before = learnt(history)
    after = before.after(signal, offset)
    nearest = float(before.nearest)
    if offset > nearest + WITHIN * SPREAD:
        assert float(after.nearest) == nearest
    else:
        step = min(nearest, offset - STEP_NEARER * SPREAD)
        assert float(after.nearest) == max(step, -STEP_NEARER * SPREAD, float(after.held))


@few
@given(OBSERVATIONS, OFFSETS, OBSERVATIONS)
def test_nothing_that_is_shown_brings_the_robot_nearer_than_was_said(before, said, after):
    known = learnt(before).after_answer(said)
    for signal, offset, days in after:
        known = known.later(days).after(signal, offset)
        assert float(known.offset) >= said


@few
@given(st.lists(st.tuples(st.sampled_from(sorted(INVITES)), st.floats(-0.6, 0.6)), max_size=12), OBSERVATIONS)
def test_invitations_alone_bring_the_robot_one_step_nearer_than_the_model_at_most(invitations, history):
    known = learnt(history)
    for signal, offset in invitations:
        known = known.after(signal, offset)
        assert float(known.offset) >= -STEP_NEARER * SPREAD


@few
@given(
    OBSERVATIONS,
    st.none() | OFFSETS,
    st.sampled_from(sorted(AWAY)),
    st.floats(-0.6, 0.5),
    st.lists(st.tuples(st.sampled_from([s for s in SIGNALS if s != "ask_closer"]), OFFSETS), max_size=6),
)
def test_a_step_back_counts_at_once_and_holds_against_earlier_words_and_later_gestures(
    history, said, signal, at, later
):
    """By what is noticed at least, until the person says otherwise."""
    known = learnt(history)
    known = known if said is None else known.after_answer(said)
    known = known.after(signal, at)
    assert float(known.offset) >= at + STEP_FARTHER * SPREAD - 1e-9
    for gesture, offset in later:
        known = known.after(gesture, offset)
        assert float(known.offset) >= at + STEP_FARTHER * SPREAD - 1e-9


@few
@given(OBSERVATIONS, OFFSETS, OFFSETS)
def test_what_the_person_says_after_a_step_back_replaces_it(history, at, said):
    known = learnt(history).after("step_back", at).after_answer(said)
    assert float(known.nearest) == said


@few
@given(
    OBSERVATIONS, st.sampled_from(["nothing", "turn_away", "step_back", "ask_farther"]), st.integers(0, 900)
)
def test_no_gap_is_closed_again_uninvited(history, signal, days):
    """Who did not invite is met no nearer next time, wherever they were met, within the bound."""
    known = learnt(history)
    at = float(known.offset)
    again = float(known.after(signal, at).later(days).offset)
    assert again >= min(at, known.spread * FARTHEST) - 1e-9


@few
@given(OBSERVATIONS)
def test_a_place_that_only_the_furniture_forced_is_no_boundary(history):
    """Met a metre farther out than wanted, because nearer there was no room."""
    known = learnt(history)
    after = known.after("nothing", float(known.offset) + 1.0)
    assert float(after.nearest) <= max(float(known.offset), float(known.nearest))


@few
@given(OBSERVATIONS)
def test_the_personal_offset_is_bounded(history):
    known = learnt(history)
    assert abs(float(known.offset)) <= FARTHEST * SPREAD + 1e-9


@few
@given(
    st.floats(-WITHIN * SPREAD, WITHIN * SPREAD),
    st.lists(st.floats(1, 60), min_size=1, max_size=8),
)
def test_who_asked_it_nearer_and_is_at_ease_there_finds_it_there_a_month_later(at, pauses):
    """Within 3 cm, at every further visit at which they show nothing; years later it may have gone back."""
    known = ComfortPosterior.before_meeting(SPREAD).after("ask_closer", at)
    asked = float(known.later(30).offset)
    assert asked == pytest.approx(-STEP_NEARER * SPREAD, abs=WITHIN * SPREAD)
    for days in pauses:
        known = known.later(days)
        assert asked - 1e-9 <= float(known.offset) <= asked + 0.03
        known = known.after("nothing", float(known.offset))


@few
@given(OBSERVATIONS, st.floats(-0.6, 0.4), st.floats(0.1, 0.99))
def test_no_end_of_an_interval_is_below_what_is_possible(history, nearest, share):
    """And where hardly any of the belief is below it, nothing changes."""
    known = learnt(history)
    low, high = (float(end) for end in known.interval(share, nearest))
    assert nearest - 1e-9 <= low < high
    assert np.allclose(known.interval(share, nearest=-10.0), known.interval(share))


@settings(max_examples=30)
@given(st.permutations([("step_back", 0.0), ("nothing", 0.2), ("turn_away", 0.1), ("lean_in", 0.4)]))
def test_the_order_of_signals_does_not_change_what_is_believed(signals):
    known = ComfortPosterior.before_meeting(SPREAD)
    for signal, offset in signals:
        known = known.after(signal, offset)
    usual = learnt([("step_back", 0.0, 0), ("nothing", 0.2, 0), ("turn_away", 0.1, 0), ("lean_in", 0.4, 0)])
    assert np.allclose(known.weights, usual.weights, atol=1e-14)


@few
@given(OBSERVATIONS)
def test_the_same_history_gives_the_same_answer(history):
    one, other = learnt(history), learnt(history)
    assert one.weights.tobytes() == other.weights.tobytes()
    assert float(one.offset) == float(other.offset)


@few
@given(OBSERVATIONS, OBSERVATIONS)
def test_many_people_at_once_are_learnt_about_one_by_one(one, other):
    """Nobody's history touches anybody else's."""
    length = min(len(one), len(other))
    together = ComfortPosterior.before_meeting(SPREAD, (2,))
    for (signal, offset, days), (signal_2, offset_2, _) in zip(one, other, strict=False):
        numbers = np.array([SIGNALS.index(signal), SIGNALS.index(signal_2)])
        together = together.later(days).after(numbers, np.array([offset, offset_2]))
    same_days = [(signal, at, days) for (signal, at, _), (_, _, days) in zip(other, one, strict=False)]
    apart = [learnt(one[:length]), learnt(same_days)]
    assert together.offset == pytest.approx([float(known.offset) for known in apart], abs=1e-9)


@given(OFFSETS, st.integers(0, 400))
def test_what_is_believed_after_an_answer_lies_between_the_model_and_the_answer(answer, days):
    """And it is nearer to the answer: one honest word counts more than where somebody is from."""
    known = ComfortPosterior.before_meeting(SPREAD).later(days).after_answer(answer)
    low, high = sorted((0.5 * answer, answer))
    assert low - 1e-9 <= mean(known) <= high + 1e-9
    assert float(known.deviation) < 0.7 * SPREAD


@given(OFFSETS, OFFSETS, st.integers(0, 400))
def test_a_farther_answer_never_leads_nearer(one, other, days):
    known = ComfortPosterior.before_meeting(SPREAD).later(days)
    near, far = (known.after_answer(answer) for answer in sorted((one, other)))
    assert mean(near) <= mean(far) + 1e-9
    assert float(near.offset) <= float(far.offset) + 1e-9


@few
@given(OBSERVATIONS, OFFSETS, st.integers(0, 400), OBSERVATIONS)
def test_the_robot_comes_no_nearer_than_the_person_said_uninvited(before, answer, days, after):
    """Whatever was shown before, and however long ago it was said."""
    known = learnt(before).after_answer(answer).later(days)
    for signal, offset, time in after:
        if signal not in INVITES:
            known = known.later(time).after(signal, offset)
    assert float(known.offset) >= answer - 1e-9


@few
@given(OBSERVATIONS, st.floats(-3, 3))
def test_an_answer_is_one_more_observation_whatever_the_order(history, answer):
    """On one day it counts as much before what was shown as after it, and never rules anything out."""
    shown_first = learnt([(signal, at, 0) for signal, at, _ in history]).after_answer(answer)
    asked_first = ComfortPosterior.before_meeting(SPREAD).after_answer(answer)
    for signal, offset, _ in history:
        asked_first = asked_first.after(signal, offset)
    assert np.allclose(shown_first.weights, asked_first.weights, atol=1e-12)
    assert (shown_first.weights > 0.0).all()


def test_an_answer_is_followed_all_the_way_out_and_with_caution_in():
    """Who likes it farther is met there; who likes it nearer is met at most 5 cm farther out than that."""
    known = ComfortPosterior.before_meeting(SPREAD)
    for answer in (0.1, 0.2, 0.3, 0.4):
        assert float(known.after_answer(answer).offset) == pytest.approx(answer)
        assert -answer - 1e-9 <= float(known.after_answer(-answer).offset) <= -answer + 0.05


def test_many_people_are_asked_at_once():
    answers = np.array([-0.2, 0.1, 0.4])
    together = ComfortPosterior.before_meeting(SPREAD, (3,)).after_answer(answers)
    apart = [float(ComfortPosterior.before_meeting(SPREAD).after_answer(answer).offset) for answer in answers]
    assert together.offset == pytest.approx(apart, abs=1e-12)


@given(st.floats(-1, 3), st.floats(0, 1.5), st.floats(0.05, 1.0), st.floats(0, 1))
def test_what_is_shown_is_a_probability(distance, near, width, chance):
    probabilities = shown(distance, near, near + width, chance=chance, edge=0.03)
    assert (probabilities >= -1e-12).all()
    assert probabilities.sum() == pytest.approx(1.0)
    assert misread(probabilities).sum() == pytest.approx(1.0)


@given(st.floats(-1, 3), st.floats(0, 1.5), st.floats(0.05, 1.0), st.floats(0, 1))
def test_what_is_weighed_is_what_is_shown(distance, near, width, chance):
    """The likelihood of the posterior and the people of the world and of the studies are one model."""
    from comity_fis.learning.showing import feelings

    probabilities = misread(shown(distance, near, near + width, chance=chance, edge=0.03))
    weighed = noticed(np.arange(6), *feelings(distance, near, near + width, 0.03), np.asarray(chance))
    assert weighed == pytest.approx(probabilities, abs=1e-12)


def test_somebody_who_never_speaks_does_not_ask():
    probabilities = shown(0.3, 0.8, 1.0, edge=0.03, repertoire=("step_back", "turn_away"))
    by_signal = dict(zip(SIGNALS, probabilities, strict=True))
    assert by_signal["ask_farther"] == 0.0
    assert by_signal["step_back"] == pytest.approx(2 / 3, abs=1e-6)
    assert (
        dict(zip(SIGNALS, shown(0.3, 0.8, 1.0, edge=0.03, repertoire=("lean_in",)), strict=True))["nothing"]
        == 1.0
    )


def test_signals_are_drawn_as_often_as_they_should_be():
    probabilities = misread(shown(0.80, 0.85, 1.1, chance=0.8, edge=0.03))
    uniform = (np.arange(10_000) + 0.5) / 10_000
    counts = np.bincount(drawn(np.broadcast_to(probabilities, (10_000, 6)), uniform), minlength=6)
    assert counts / 10_000 == pytest.approx(probabilities, abs=1.5e-4)


def test_two_requests_outweigh_the_prior():
    """Somebody who twice asked for more distance is met a good way farther out."""
    known = learnt([("ask_farther", 0.0, 0), ("ask_farther", 0.15, 30)])
    assert float(known.offset) > 0.3
    assert float(known.interval(0.6)[0]) > 0.1
