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
    "words", ["Kurdistan", "Kurdish", "Roma", "Sami", "Catalan", "Germny", "Korea", "Ewe"]
)
def test_a_people_has_its_own_name_and_is_never_taken_for_another(words):
    assert find_score(words) is None
    with pytest.raises(InputError, match="which has none") as refusal:
        score(words)
    assert "Did you mean" not in str(refusal.value)


@pytest.mark.parametrize("words", ["GER", "JPM", "XX", ""])
def test_a_code_that_no_country_has_is_refused_without_a_guess(words):
    with pytest.raises(InputError, match="ISO 3166") as refusal:
        find_score(words)
    assert "Did you mean" not in str(refusal.value)


def test_egypt_has_no_score_and_none_is_guessed():
    with pytest.raises(InputError, match=r"'EGY', which has none.* a region: Arab countries, East Africa"):
        score("EGY")
    assert find_score("EGY") is find_score("Egypt") is find_score("eg") is None


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
