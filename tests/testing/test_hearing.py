"""Who hears what the robot says: whom it speaks to, and everybody whom it greets together with them."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from comity.testing.collection.cases import claims_in
from comity.testing.kinds.hearing import Hearing
from comity.testing.trials.attempt import attempted
from comity_fis import InputError
from tests.testing.conftest import in_a_group


def test_a_group_and_each_of_its_members_hear_what_is_said_to_all_of_them(judge):
    said = ("pair hears 'Hello'", "guest hears 'Hello'", "sam hears 'Hello'", "host hears 'Hello, Host.'")
    (verdict,) = judge("Greet_company succeeds exactly once", *said, room=in_a_group)
    assert verdict.passed, verdict.failures


def test_what_a_group_does_not_hear_is_told_of_each_member_with_what_they_heard(judge):
    (verdict,) = judge("pair hears 'Good morning'", room=in_a_group)
    found = {failure.finding.expected: failure.finding for failure in verdict.failures}
    assert list(found) == ["“Good morning” to guest, of pair", "“Good morning” to sam, of pair"]
    for finding in found.values():
        assert re.fullmatch("“Hello, (Guest and Sam|Sam and Guest).”", finding.got)
        assert any(re.match(r"t=[\d.]+ s  say\((guest|sam)\) success", line) for line in finding.because)
    told = [
        line for finding in found.values() for line in finding.because if "is greeted together with" in line
    ]
    assert len(told) == 1, "of the one before whom the robot does not stand"


def test_a_member_who_is_greeted_alone_hears_nothing_of_what_is_said_to_the_others(judge):
    """Sam gets more than a greeting, and so is greeted alone."""
    (verdict,) = judge("sam hears 'Tea?'", "pair hears 'Tea?'", room=with_tea)
    (failure,) = verdict.failures
    assert failure.finding.expected == "“Tea?” to guest, of pair"
    assert failure.finding.got == "“Hello, Guest.”"


def test_what_one_member_hears_is_too_much_where_the_group_never_hears_it(judge):
    (verdict,) = judge("pair never hears 'Tea?'", "guest never hears 'Tea?'", room=with_tea)
    (failure,) = verdict.failures
    assert failure.finding.expected == "never “Tea?” to sam, of pair"
    assert failure.finding.got == "“Tea?”"
    assert any("say(sam)" in line for line in failure.finding.because)


def test_what_was_said_too_much_is_told_with_the_step_that_said_it_and_not_a_later_one(judge):
    (verdict,) = judge(
        "host never hears 'Hello'",
        "host never hears 'Tea'",
        room=lambda room: room.replace(
            "  - greet: host\n", "  - greet: host\n  - {say: Tea?, to: host}\n  - take_leave: host\n"
        ),
    )
    steps = [[line for line in failure.finding.because if "step " in line] for failure in verdict.failures]
    assert [re.search(r"step +(\w+)", *lines)[1] for lines in steps] == ["Greet_person", "Say"]


def test_who_hears_not_a_word_for_noise_is_told_so(judge):
    (verdict,) = judge(
        "host hears 'Hello'", room=lambda room: room.replace("  host: {", "  host: {noise_db: 90, ")
    )
    (failure,) = verdict.failures
    assert failure.finding.got == "not a word"
    assert any("noise of 90 dB drowns" in line for line in failure.finding.because)


@pytest.mark.parametrize("nothing", ["''", '" "', "'  '"])
def test_words_are_more_than_spaces(write, nothing):
    with pytest.raises(InputError, match="got quotes with nothing in them"):
        claims_in(write(f"host never hears {nothing}"))


def test_words_that_were_broken_off_were_heard_for_all_one_knows_and_not_to_the_end(write):
    (claim,) = claims_in(write())
    trial = attempted(claim.case)
    acts = tuple(replace(act, stopped=True) for act in trial.acts)
    broken_off = replace(trial, acts=acts)
    for never in (False, True):
        (finding,) = Hearing("host", never, "Hello").judge(broken_off)
        assert finding.got == "“Hello, Host.” (broken off)"


def test_who_is_spoken_to_in_a_sentence_is_somebody_or_a_group(write):
    with pytest.raises(InputError) as refused:
        claims_in(write("pear hears 'Hello'", room=in_a_group))
    assert "a person from `people`, or one of `groups`, got 'pear'. Did you mean 'pair'?" in str(
        refused.value
    )


def with_tea(room: str) -> str:
    return in_a_group(room).replace("  - greet: sam\n", "  - greet: sam\n  - {say: Tea?, to: sam}\n")


@pytest.mark.parametrize("member", ["guest", "sam"])
def test_a_choice_of_a_company_is_one_for_each_of_its_members(judge, member):
    """Before whichever of them the robot stands: `comity plan` tells it of all of them."""
    (verdict,) = judge(
        f"visiting {member} with a handshake is excluded because 'touch consent'",
        f"visiting {member} with 'one by one' would cost at least 1 cm more",
        room=in_a_group,
    )
    assert verdict.passed, verdict.failures


@pytest.mark.parametrize("member", ["guest", "sam"])
def test_a_node_of_a_member_before_whom_the_robot_does_not_stand_never_ran(judge, member):
    """It is none that the tree could not have: greeted alone, they would have it."""
    (verdict,) = judge(f"""'"docked?({member})" succeeds at most once'""", room=in_a_group)
    assert verdict.passed, verdict.failures


def test_one_member_has_a_node_of_docking_and_of_the_other_it_is_told_why_there_is_none(judge):
    exactly = [f"""'"docked?({member})" succeeds exactly once'""" for member in ("guest", "sam")]
    (verdict,) = judge(*exactly, room=in_a_group)
    (failure,) = verdict.failures
    assert any("Greet_company" in line for line in failure.finding.because)


def test_a_node_that_no_tree_has_is_refused_of_a_member_too(judge):
    with pytest.raises(InputError, match="a node of the behaviour tree"):
        judge("""'"dokced?(sam)" succeeds at most once'""", room=in_a_group)
