"""Leaves turn exceptions into failures, and end once whatever they began."""

from __future__ import annotations

import pytest
from py_trees.common import Status

from comity_executor.nodes.leaf import Action, Condition


class Counting(Action):
    """Goes on until told otherwise; counts its ends."""

    def __init__(self, fails_in: str = "", result: Status = Status.RUNNING) -> None:
        super().__init__("counting")
        self.fails_in = fails_in
        self.result = result
        self.ends = 0

    def begin(self) -> None:
        if self.fails_in == "begin":
            raise ValueError("no begin")

    def step(self) -> Status:
        if self.fails_in == "step":
            raise KeyError("no step")
        return self.result

    def end(self) -> None:
        self.ends += 1
        if self.fails_in == "end":
            raise OSError("the brake does not answer")


class Raising(Condition):
    def check(self) -> bool:
        raise ZeroDivisionError("no distance")


@pytest.mark.parametrize(
    ("where", "text"), [("begin", "ValueError: no begin"), ("step", "KeyError: 'no step'")]
)
def test_an_exception_is_a_failure_with_text_and_the_leaf_ends(where: str, text: str) -> None:
    leaf = Counting(where)
    leaf.tick_once()
    assert leaf.status is Status.FAILURE
    assert leaf.account().text.startswith(text)
    assert leaf.ends == 1


def test_the_text_is_forgotten_when_the_next_round_goes_well() -> None:
    leaf = Counting("step")
    leaf.tick_once()
    leaf.fails_in = ""
    leaf.tick_once()
    assert leaf.account() is None


def test_an_exception_in_a_condition_is_a_failure_with_text() -> None:
    leaf = Raising("near?")
    leaf.tick_once()
    assert leaf.status is Status.FAILURE
    assert leaf.account().text.startswith("ZeroDivisionError: no distance")


@pytest.mark.parametrize("result", [Status.SUCCESS, Status.FAILURE, Status.RUNNING])
def test_a_leaf_ends_once_a_round(result: Status) -> None:
    """py_trees terminates it again whenever it resets the branch."""
    leaf = Counting(result=result)
    leaf.tick_once()
    leaf.stop(Status.INVALID)
    leaf.stop(Status.INVALID)
    assert leaf.ends == 1


def test_an_end_that_raises_leaves_the_others_alone_and_is_to_be_tried_again() -> None:
    leaf = Counting("end")
    leaf.tick_once()
    leaf.stop(Status.INVALID)
    assert leaf.has_to_end_again
    assert leaf.account().text.startswith("OSError: the brake does not answer")
    leaf.fails_in = ""
    leaf.try_to_end()
    assert not leaf.has_to_end_again
