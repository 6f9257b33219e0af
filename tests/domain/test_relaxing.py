"""Which conditions stand in the way."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from comity_domain import in_the_way

conditions = st.lists(st.integers(0, 20), unique=True, max_size=6)


@given(conditions, st.lists(st.sets(st.integers(0, 20), min_size=1, max_size=3), max_size=4))
def test_what_is_named_helps_and_nothing_of_it_is_idle(held, keys):
    """There is a way as soon as all of one of several sets of conditions are lifted."""

    def possible(lifted):
        return any(key <= set(lifted) for key in keys)

    found = in_the_way(held, possible)
    assert all(possible([one]) for one in found.any_of)
    assert not (found.any_of and found.all_of)
    if found.all_of:
        assert possible(found.all_of)
        assert not any(possible([o for o in found.all_of if o != one]) for one in found.all_of)
    elif not found.any_of:
        assert not possible(held) or possible([])
