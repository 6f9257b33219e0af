"""A part of a rulebook."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import InputError
from comity_fis.rulebook.selection import selected


@given(st.data())
def test_a_part_gives_what_the_whole_gives(bruno2017, data):
    names = data.draw(st.sets(st.sampled_from(list(bruno2017.parameters)), min_size=1))
    part = selected(bruno2017, names)
    assert set(part.parameters) >= names
    individualism = data.draw(st.none() | st.floats(6, 91))
    gender = data.draw(st.sampled_from([None, "female", "male"]))
    known = {"individualism": individualism, "gender": gender, "touch_consent": "given"}
    whole = bruno2017.infer(known)
    answers = part.infer({name: value for name, value in known.items() if name in part.variables})
    for name in part.parameters:
        assert answers[name].value == whole[name].value
        assert answers[name].desirability == whole[name].desirability


def test_what_nobody_needs_is_left_out(bruno2017):
    part = selected(bruno2017, ["conversational_distance"])
    assert list(part.parameters) == ["conversational_distance"]
    assert list(part.variables) == ["individualism", "gender"]
    assert [rule.number for rule in part.rules] == [1, 2, 3, 4]


def test_a_parameter_that_the_rules_read_comes_along(small):
    readers = [name for name in small.parameters if set(small.reads(name)) & small.parameters.keys()]
    assert readers
    for name in readers:
        assert set(selected(small, [name]).parameters) > {name}


def test_an_unknown_parameter_is_refused(bruno2017):
    with pytest.raises(InputError, match="Did you mean 'approach_speed'"):
        selected(bruno2017, ["aproach_speed"])
