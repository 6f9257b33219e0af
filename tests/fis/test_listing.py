"""Names in a sentence."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis.listing import listed


@pytest.mark.parametrize(
    ("names", "said"),
    [((), ""), (("ada",), "ada"), (("ada", "ben"), "ada or ben"), (("ada", "ben", "eve"), "ada, ben or eve")],
)
def test_names_are_listed_as_in_a_sentence(names, said):
    assert listed(names, "or") == said


@given(st.lists(st.text("abc", min_size=1), min_size=1))
def test_a_list_has_every_name_once_and_in_its_order(names):
    assert listed(iter(names)).replace(" and ", ", ").split(", ") == names
