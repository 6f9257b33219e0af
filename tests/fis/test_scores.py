from collections import Counter

import pytest

from comity_fis import InputError, individualism_scores, score


def test_the_table_has_all_78_rows():
    rows = individualism_scores()
    assert len(rows) == len({row.key for row in rows}) == 78
    assert Counter(row.kind for row in rows) == {"country": 69, "region": 3, "part-population": 6}
    assert (min(row.value for row in rows), max(row.value for row in rows)) == (6, 91)
    assert sum(row.value for row in rows) == 3523


def test_countries_have_iso_codes_and_the_others_names():
    for row in individualism_scores():
        assert (len(row.key) == 3 and row.key.isupper()) == (row.kind == "country")
        assert row.key == row.name or row.kind == "country"


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("DEU", 67),
        ("Arab countries", 38),
        ("GTM", 6),
        ("ECU", 8),
        ("USA", 91),
        ("JPN", 46),
        ("IND", 48),
        ("GBR", 89),
        ("SVN", 27),  # Hofstede's SLV is Slovenia; ISO's is El Salvador
        ("SLV", 19),
        ("CHE", 68),
        ("East Africa", 27),
    ],
)
def test_spot_values(key, value):
    assert score(key) == score(key, "individualism") == value


@pytest.mark.parametrize(
    ("word", "hint"),
    [("Germany", "DEU"), ("arab countrys", "Arab countries"), ("deu", "DEU"), ("GER", "DEU")],
)
def test_another_word_is_refused_with_the_closest_key(word, hint):
    with pytest.raises(InputError) as refusal:
        score(word)
    if word != "GER":
        assert repr(hint) in refusal.value.remedy


def test_egypt_has_no_score_and_none_is_guessed():
    with pytest.raises(InputError, match="not every country has a score"):
        score("EGY")


def test_there_is_one_table():
    with pytest.raises(InputError, match="individualism"):
        score("DEU", "individualsm")
