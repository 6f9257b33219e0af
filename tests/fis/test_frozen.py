"""Nobody can change a rulebook that others use."""

from __future__ import annotations

import copy
import pickle

import pytest

from comity_fis import load_rulebook

KNOWN = {"individualism": 38, "gender": "female"}


@pytest.mark.parametrize("name", ["bruno2017", "evidence", "illustrative-levels"])
def test_no_mapping_of_a_rulebook_takes_a_change(name):
    book = load_rulebook(name)
    inside = [book.variables, book.parameters, book.sources, book.coercions]
    inside += [variable.terms for variable in book.variables.values()]
    inside += [one.terms for one in book.parameters.values() if not isinstance(one.terms, tuple)]
    for mapping in filter(None, inside):
        key = next(iter(mapping))
        for change in (
            lambda m, k: m.__setitem__(k, None),
            lambda m, k: m.__delitem__(k),
            lambda m, k: m.pop(k),
            lambda m, k: m.update({k: None}),
            lambda m, k: m.setdefault("new", None),
            lambda m, _: m.popitem(),
            lambda m, _: m.clear(),
            lambda m, k: m.__ior__({k: None}),
        ):
            with pytest.raises(TypeError, match="a rulebook does not change"):
                change(mapping, key)
        assert key in mapping


def test_what_was_given_to_a_rulebook_can_change_without_it():
    """The caller's own dictionary is copied."""
    from dataclasses import replace

    book = load_rulebook("bruno2017-case2")
    mine = dict(book.variables)
    own = replace(book, variables=mine)
    mine.clear()
    assert own.value("conversational_distance", KNOWN) == book.value("conversational_distance", KNOWN)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda b: pickle.loads(pickle.dumps(b))])
def test_a_copy_answers_the_same_and_is_as_frozen(copied):
    book = load_rulebook("bruno2017-case2")
    other = copied(book)
    assert other == book
    assert other.value("conversational_distance", KNOWN) == book.value("conversational_distance", KNOWN)
    with pytest.raises(TypeError):
        del other.variables["gender"]
