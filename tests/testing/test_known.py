"""What passed before is known by all that it depends on, and by nothing less."""

from __future__ import annotations

from pathlib import Path

import pytest

import comity_fis
from comity.testing.cases import claims_in
from comity.testing.known import Known, key_of
from comity.testing.plans import KeptOrders
from comity.testing.result import known_or_result
from comity_domain import Order
from comity_domain.tour import Stop


def key(path):
    return key_of(claims_in(path)[0])


def test_the_same_test_has_the_same_key(write):
    path = write("finishes within 60 s")
    assert key(path) == key(path)


@pytest.mark.parametrize(
    ("was", "becomes"),
    [
        ("at_m: [1.0, 1.0]", "at_m: [1.0, 1.1]"),
        ("profile: arab_woman", "profile: arab_man"),
        ("finishes within 60 s", "finishes within 61 s"),
        ("facing_deg: 180", "facing_deg: 170"),
    ],
)
def test_whatever_matters_changes_the_key(was, becomes, write):
    path = write("finishes within 60 s")
    before = key(path)
    path.write_text(path.read_text().replace(was, becomes))
    assert key(path) != before


def test_a_rule_changes_the_key_only_of_those_whose_values_it_moves(write, tmp_path):
    """The rule about Japan moves nobody here; the one about women of low individualism does."""
    text = (Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml").read_text()
    (tmp_path / "rules.yaml").write_text(text)
    path = write(room=lambda room: "rulebook: rules.yaml\n" + room)
    before = key(path)
    (tmp_path / "rules.yaml").write_text(
        text.replace(
            "culture is JPN then greeting_gesture is bow", "culture is JPN then greeting_gesture is nod"
        )
    )
    assert key(path) == before
    (tmp_path / "rules.yaml").write_text(
        text.replace(
            "gender is female then conversational_distance is close",
            "gender is female then conversational_distance is far",
        )
    )
    assert key(path) != before


def test_only_what_passed_is_known(write, tmp_path):
    known = Known(tmp_path / "known")
    (passing,) = claims_in(write("finishes within 60 s"))
    first = known_or_result(passing, known)
    again = known_or_result(passing, known)
    assert (first.status, again.status) == ("passed", "passed")
    assert first.measured == again.measured
    (failing,) = claims_in(write("finishes within 1 s"))
    assert known_or_result(failing, known).status == "failed"
    assert len(list((tmp_path / "known").iterdir())) == 1


def test_an_order_is_kept_whole_or_not_at_all(tmp_path):
    kept = KeptOrders(tmp_path / "orders")
    order = Order(
        "fast-downward", (Stop("host"), Stop("guest", "window")), proven=True, reproducible=True, bound=7
    )
    assert kept.recall("key") is None
    kept.keep("key", order)
    assert kept.recall("key") == order
    (tmp_path / "orders" / "key").write_text("{")
    assert kept.recall("key") is None
