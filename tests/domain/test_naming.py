from __future__ import annotations

import re

from hypothesis import given
from hypothesis import strategies as st

from comity_domain.classical.naming import RESERVED, PddlWord, name_all

words = st.lists(st.builds(PddlWord, st.sampled_from(["user", "side", "gesture"]), st.text(max_size=8)))


@given(words)
def test_every_name_becomes_one_word_of_its_own_and_comes_back(given_words):
    names = name_all(given_words)
    ids = [names.id(word.kind, word.name) for word in dict.fromkeys(given_words)]
    assert len(set(ids)) == len(ids)
    assert [names.name(id_) for id_ in ids] == [word.name for word in dict.fromkeys(given_words)]
    assert all(re.fullmatch(r"[a-z][a-z0-9_]*", id_) and id_ not in RESERVED for id_ in ids)


def test_a_plain_name_keeps_itself_and_others_stay_readable():
    names = ["johanna", "Johanna", "Zoë", "Anna-Lena", "front", "robot", "3", "東京"]
    ids = name_all([PddlWord("side", "front"), *(PddlWord("user", name) for name in names)])
    assert [ids.id("user", name) for name in names] == [
        *("johanna", "johanna_1", "zoe", "anna_lena", "front_1", "robot_1", "user_3", "user_1"),
    ]
