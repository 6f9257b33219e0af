"""Records that are filled in when they are read are like any others to their reader."""

import copy
import pickle
from dataclasses import FrozenInstanceError, dataclass, replace

import pytest

from comity_domain.plans.lazy_record import LazyRecord


@dataclass(frozen=True, slots=True)
class Pair(LazyRecord):
    """Two fields."""

    first: int
    second: str


def unread(calls):
    """A pair that notes when the rest of it is worked out."""

    def whole():
        calls.append("worked out")
        return Pair(1, "one")

    return Pair.lazy(whole, first=1)


def test_what_is_there_is_read_without_working_out_the_rest():
    calls = []
    assert unread(calls).first == 1
    assert calls == []


def test_the_rest_is_worked_out_once():
    calls = []
    pair = unread(calls)
    assert (pair.second, pair.second) == ("one", "one")
    assert calls == ["worked out"]


def test_it_equals_the_same_record_made_at_once():
    assert unread([]) == Pair(1, "one")
    assert repr(unread([])) == repr(Pair(1, "one"))
    assert hash(unread([])) == hash(Pair(1, "one"))


def test_it_is_frozen_and_can_be_replaced_copied_and_sent():
    pair = unread([])
    with pytest.raises(FrozenInstanceError):
        pair.second = "two"
    assert replace(pair, second="two") == Pair(1, "two")
    assert copy.copy(unread([])) == copy.deepcopy(unread([])) == Pair(1, "one")
    assert pickle.loads(pickle.dumps(unread([]))) == Pair(1, "one")


def test_it_has_no_other_attributes():
    with pytest.raises(AttributeError, match="Pair has no third"):
        _ = unread([]).third
    assert not hasattr(Pair(1, "one"), "third")
