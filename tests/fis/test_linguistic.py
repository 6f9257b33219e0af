"""The paper's three cases of making a variable linguistic, each on the paper's own variable."""

import pickle

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from comity_fis import (
    Coercion,
    InputError,
    Interval,
    Level,
    OneClusterError,
    all_known,
    cluster_counts,
    from_data,
    individualism_scores,
    load_rulebook,
    terms_known,
    variable_data,
)
from comity_fis.errors import ManyInputErrors, Where, WrongValueError
from comity_fis.validation.yaml_file import dump_yaml

SCORES = [row.value for row in individualism_scores()]
TREATED = Coercion(Level.INTERVAL, "the paper clusters them")
STAGES = ["toddler", "pre_adolescent", "adolescent", "adult", "elderly"]


def age(**changes):
    given = {
        "terms": STAGES,
        "boundaries": [3, 12, 19, 65],
        "overlaps": [2, 4, 4, 10],
        "level": Level.RATIO,
        "unit": "years",
        "reason": "stages of life; where they meet is a design choice",
    }
    return terms_known("age", (0, 117), **{**given, **changes})


def test_all_known_nominal_gender():
    gender = all_known("gender", ["female", "male"], reason="the paper's")
    assert gender.terms.keys() == {"female", "male"}
    assert (gender.terms["female"]("female"), gender.terms["female"]("male")) == (1, 0)
    assert gender == all_known("gender", ("female", "male"), reason="the paper's")


def test_all_known_ordinal_isced():
    shipped = load_rulebook("illustrative-levels").variables["education"]
    built = all_known(
        "education",
        shipped.categories,
        ordered=True,
        numbered_from=0,
        groups={name: group.members for name, group in shipped.groups.items()},
        reason=shipped.reason,
    )
    assert built == shipped
    assert len(shipped.categories) == 9
    assert built.terms["high"](built.check(6)) == 1
    assert built.terms["low"](built.check("2")) == 1


@pytest.mark.parametrize("value", [6, 6.0, "6", "bachelor"])
def test_a_numbered_category_goes_by_number_or_name(value):
    assert load_rulebook("illustrative-levels").variables["education"].check(value) == "bachelor"


@pytest.mark.parametrize("value", [9, -1, 6.5, "9", "bachelr", True, None, float("nan"), "9" * 5000])
def test_what_is_no_category_is_refused(value):
    with pytest.raises(InputError, match="education as"):
        load_rulebook("illustrative-levels").variables["education"].check(value)


def test_a_group_of_an_ordinal_variable_has_no_gap():
    with pytest.raises(WrongValueError, match="consecutive"):
        all_known("x", "abc", ordered=True, groups={"ends": "ac"}, reason="made up")
    assert all_known("x", "abc", groups={"ends": "ac"}, reason="made up").terms["ends"]("c") == 1


def test_numbers_need_an_order():
    with pytest.raises(WrongValueError, match="without an order"):
        all_known("x", "abc", numbered_from=0, reason="made up")


def test_terms_known_age():
    for rulebook in ("bruno2017", "illustrative-levels"):
        assert age().terms == load_rulebook(rulebook).variables["age"].terms


def test_terms_known_latitude_meets_at_the_tropics_and_the_polar_circles():
    shipped = load_rulebook("illustrative-levels").variables["latitude"]
    built = terms_known(
        "latitude", (-90, 90), terms=list(shipped.terms), boundaries=[-66.56, -23.44, 23.44, 66.56],
        overlaps=5, level=Level.INTERVAL, reason="made up",
    )  # fmt: skip
    for name, term in built.terms.items():
        assert term.knots == pytest.approx(shipped.terms[name].knots)


widths = st.lists(st.floats(0.01, 10), min_size=1, max_size=5)


@given(widths, st.floats(0, 0.99), st.data())
def test_known_terms_share_every_value_out_completely(widths, share, data):
    boundaries = [sum(widths[: i + 1]) for i in range(len(widths))]
    high = boundaries[-1] + widths[-1]
    overlap = share * min(widths)
    variable = terms_known(
        "x", (0, high), terms=[f"t{i}" for i in range(len(widths) + 1)], boundaries=boundaries,
        overlaps=overlap, level=Level.RATIO, reason="made up",
    )  # fmt: skip
    x = data.draw(st.floats(0, high))
    assume(overlap > 1e-6 or x not in boundaries)  # both sides of a sharp boundary have the boundary itself
    assert sum(term(x) for term in variable.terms.values()) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize(
    "wrong",
    [
        {"boundaries": [19, 12, 40, 65]},
        {"boundaries": [12, 19, 40]},
        {"boundaries": [12, 19, 40, 116]},
        {"overlaps": [4, 14, 10, 10]},
        {"overlaps": -1},
        {"terms": ["child"] * 5},
        {"boundaries": [12, 19, float("nan"), 65]},
        {"level": Level.ORDINAL},
        {"level": "rational"},
        {"level": None},
        {"reason": " "},
    ],
)
def test_terms_that_cannot_be_are_refused(wrong):
    with pytest.raises(InputError, match=r"expected .*, got "):
        age(**wrong)


@pytest.mark.parametrize(("categories", "reason"), [([], "x"), ([1, 2], "x"), (["a", ""], "x"), (["a"], "")])
def test_categories_that_cannot_be_are_refused(categories, reason):
    with pytest.raises(InputError):
        all_known("x", categories, reason=reason)


def test_a_level_goes_by_its_name_too():
    assert age(level="ratio") == age()


def test_what_a_record_refuses_is_bad_input_and_survives_pickle():
    with pytest.raises(InputError) as refusal:
        Interval(60, 40)
    again = pickle.loads(pickle.dumps(refusal.value))
    assert isinstance(again, WrongValueError)
    assert str(again) == str(refusal.value)


def test_errors_that_are_told_together_survive_pickle_and_stay_where_they_are():
    errors = [InputError(expected=f"{i}", got="x", remedy="Y.", where=Where("f", i)) for i in range(1, 15)]
    several = pickle.loads(pickle.dumps(ManyInputErrors(errors)))
    assert str(several).splitlines() == [*map(str, errors[:12]), "... and 2 more of this kind."]
    assert several.at(Where("elsewhere")).where == Where("f", 1)


@pytest.mark.parametrize("source", [None, 7])
def test_what_is_no_rulebook_is_refused(source):
    with pytest.raises(InputError, match="by name or path"):
        load_rulebook(source)


def test_from_data_individualism():
    shipped = load_rulebook("bruno2017").variables["individualism"]
    built = from_data(
        "individualism", SCORES, domain=(0, 100), level=Level.ORDINAL, coercion=TREATED, reason="the paper's"
    )
    assert built.shapes == "fitted"
    assert built.partition.centres == pytest.approx(shipped.partition.centres, abs=1e-8)
    for score in range(101):
        for term in ("LC1", "LC2"):
            assert built.terms[term](score) == pytest.approx(shipped.terms[term](score), abs=1e-7)


def test_ordinal_data_are_not_clustered_without_a_declared_coercion():
    with pytest.raises(InputError, match=r"interval level for the partition of individualism.*coercion"):
        from_data("individualism", SCORES, level=Level.ORDINAL, reason="the paper's")


def test_the_number_of_clusters_over_radii():
    counts = cluster_counts(SCORES)
    assert {radius for radius, count in counts.items() if count == 2} == {r / 20 for r in range(7, 16)}
    assert counts[1.0] == 1


def test_one_cluster_is_said_with_its_centre():
    with pytest.raises(OneClusterError) as answer:
        from_data("x", SCORES, radius=0.9, level=Level.INTERVAL, reason="made up")
    assert answer.value.centre in SCORES
    assert "0.9" in str(answer.value)


@pytest.mark.parametrize(
    ("values", "options", "expected"),
    [
        ([1, 2, 3, 3], {}, "at least 4 different"),
        ([7.0] * 50, {}, "at least 4 different"),
        ([], {}, "at least 4 different"),
        ([1, 2, 3, 4, 5, float("nan")], {}, "in 1..5"),
        (range(6001), {}, "at most 5000"),
        (SCORES, {"domain": (0, 50)}, "Widen the range"),
        (range(200), {"radius": 0.01}, "at most 12 groups"),
    ],
)
def test_data_that_make_no_terms_are_refused_with_a_remedy(values, options, expected):
    with pytest.raises(InputError, match=expected):
        from_data("x", values, level=Level.INTERVAL, reason="made up", **options)


@pytest.mark.parametrize("made", ["age", "individualism"])
def test_what_is_written_loads_in_a_rulebook(write, made):
    variable = age() if made == "age" else from_data(
        "individualism", SCORES, level=Level.ORDINAL, coercion=TREATED, unit="points", reason="the paper's"
    )  # fmt: skip
    fragment = dump_yaml({made: variable_data(variable)}, inline=True)
    indented = "".join(f"  {line}\n" for line in fragment.splitlines())
    path = write(("variables:\n", f"variables:\n{indented}"))
    read = load_rulebook(path).variables[made]
    assert (read.level, read.coercion, read.unit, read.reason) == (
        variable.level, variable.coercion, variable.unit, variable.reason,
    )  # fmt: skip
    assert read.domain == variable.domain
    for x in range(6, 92):
        for name, term in variable.terms.items():
            assert read.terms[name](x) == pytest.approx(term(x), abs=1e-9)
