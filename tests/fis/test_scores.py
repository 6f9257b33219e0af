from collections import Counter

import pytest

from comity_fis import InputError, countries, country, find_score, individualism_scores, score


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
    assert score(key) == value


@pytest.mark.parametrize(
    ("word", "hint"),
    [("Germny", "Germany"), ("arab countrys", "Arab countries"), ("Sweeden", "Sweden"), ("GER", "Germany")],
)
def test_another_word_is_refused_with_the_closest_name(word, hint):
    with pytest.raises(InputError) as refusal:
        score(word)
    assert repr(hint) in refusal.value.remedy


def test_egypt_has_no_score_and_none_is_guessed():
    with pytest.raises(InputError, match=r"'EGY', which has none.* a region: Arab countries, East Africa"):
        score("EGY")
    assert find_score("EGY") is find_score("Egypt") is find_score("eg") is None


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("Korea", "Did you mean 'North Korea' or 'South Korea'?"),
        ("guinea-", "Did you mean "),
        ("Sudann", "Did you mean 'Sudan'?"),
    ],
)
def test_a_name_that_several_countries_share_offers_them_all(words, offered):
    with pytest.raises(InputError) as refusal:
        find_score(words)
    assert offered in refusal.value.remedy


def test_kosovo_is_known_and_has_no_score():
    assert find_score("Kosovo") is find_score("XKX") is None
    with pytest.raises(InputError, match="let the person name a region"):
        score("Kosovo")


def test_every_country_of_the_table_is_found_by_code_and_by_name():
    for row in individualism_scores():
        for words in (row.key, row.name, row.name.lower()):
            assert find_score(words) == row
        known = country(row.key)
        assert known is None or all(find_score(words) == row for words in known.spellings)


def test_every_country_in_the_world_is_known_and_none_is_taken_for_another():
    spellings = [words.casefold() for one in countries() for words in one.spellings]
    assert len(countries()) == len({one.alpha3 for one in countries()}) == 250
    assert len(spellings) == len(set(spellings))
    scored = {row.key for row in individualism_scores() if row.kind == "country"}
    for one in countries():
        assert (find_score(one.name) is not None) == (one.alpha3 in scored)
