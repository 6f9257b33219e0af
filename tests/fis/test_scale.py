"""A level of measurement allows what it allows and refuses the rest, in so many words."""

import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import InputError, Level, all_known, individualism_scores, load_rulebook
from comity_fis.variables.scale import NEEDS

SCORES = [row.value for row in individualism_scores()]
LEVELS = load_rulebook("illustrative-levels").variables
AGES = st.floats(0, 117)


def test_the_four_variables_are_at_the_four_levels():
    assert [variable.level for variable in LEVELS.values()] == list(Level)


@pytest.mark.parametrize("operation", NEEDS)
@pytest.mark.parametrize("variable", LEVELS.values(), ids=list(LEVELS))
def test_an_operation_is_there_exactly_where_the_level_allows_it(variable, operation):
    allowed = variable.level >= NEEDS[operation]
    if allowed:
        assert callable(getattr(variable.scale, operation))
    else:
        with pytest.raises(
            InputError, match=f"{NEEDS[operation]} level for the {operation} of {variable.name}"
        ):
            getattr(variable.scale, operation)


def test_a_coercion_opens_what_the_level_closes_and_is_shown():
    variable = load_rulebook("bruno2017").variables["individualism"]
    assert variable.level is Level.ORDINAL
    assert variable.measured == "ordinal, treated as interval"
    assert variable.scale.coercion.reason
    assert variable.scale.mean(SCORES) == pytest.approx(sum(SCORES) / 78)
    assert len(variable.scale.partition(SCORES).terms) == 2
    with pytest.raises(InputError, match="ratio level for the ratio of individualism"):
        variable.scale.ratio(67, 38)


def test_a_refusal_names_the_remedy_only_where_there_is_one():
    with pytest.raises(InputError, match="declare a coercion to interval with a reason"):
        LEVELS["education"].scale.mean(["primary"])
    with pytest.raises(InputError) as refusal:
        LEVELS["gender"].scale.mean(["female"])
    assert "coercion" not in str(refusal.value)


def test_a_type_checker_refuses_the_same(tmp_path: Path):
    program = tmp_path / "program.py"
    program.write_text(
        "from comity_fis import IntervalScale, NominalScale, OrdinalScale, RatioScale\n"
        "def allowed(n: NominalScale[str], o: OrdinalScale[str], i: IntervalScale, r: RatioScale) -> None:\n"
        "    n.equal('a', 'b'), o.before('a', 'b'), i.mean([1.0]), r.ratio(1.0, 2.0)\n"
        "def refused(n: NominalScale[str], o: OrdinalScale[str], i: IntervalScale) -> None:\n"
        "    n.before('a', 'b')\n"
        "    o.mean(['a'])\n"
        "    i.ratio(1.0, 2.0)\n"
    )
    said = subprocess.run(
        [sys.executable, "-m", "mypy", "--no-incremental", str(program)],
        capture_output=True, text=True, cwd=Path(__file__).parents[2], check=False,
    ).stdout  # fmt: skip
    ours = [line for line in said.splitlines() if line.startswith(str(program))]
    assert [line.split(":")[1] for line in ours if "attr-defined" in line] == ["5", "6", "7"], said


@given(st.lists(AGES, min_size=1))
def test_the_mean_lies_between_the_least_and_the_greatest(ages):
    assert min(ages) - 1e-9 <= LEVELS["age"].scale.mean(ages) <= max(ages) + 1e-9


@given(AGES, AGES, AGES)
def test_distance_is_a_metric(a, b, c):
    distance = LEVELS["age"].scale.distance
    assert distance(a, b) == distance(b, a) >= 0
    assert distance(a, a) == 0
    assert distance(a, c) <= distance(a, b) + distance(b, c) + 1e-9


@given(st.lists(st.sampled_from(LEVELS["education"].categories), min_size=1))
def test_the_median_is_one_of_the_values_with_at_most_half_before_it(levels):
    scale = LEVELS["education"].scale
    median = scale.median(levels)
    assert median in levels
    assert sum(scale.before(level, median) for level in levels) <= len(levels) / 2
    assert sum(scale.before(median, level) for level in levels) <= len(levels) / 2


@given(st.lists(st.sampled_from(LEVELS["education"].categories), min_size=1), st.permutations(range(9)))
def test_the_mode_needs_no_order(levels, order):
    categories = [LEVELS["education"].categories[i] for i in order]
    assert all_known("x", categories, reason="made up").scale.mode(levels) == LEVELS["education"].scale.mode(
        levels
    )


def test_twice_as_old_is_said_of_a_ratio_and_nothing_is_twice_zero():
    scale = LEVELS["age"].scale
    assert scale.ratio(80, 40) == 2
    with pytest.raises(InputError, match="other than 0"):
        scale.ratio(80, 0)


@pytest.mark.parametrize("value", [-1, 118, float("nan"), "old", True])
def test_what_is_no_value_is_refused_before_anything_is_computed(value):
    with pytest.raises(InputError, match="age as a number"):
        LEVELS["age"].scale.mean([40, value])


def test_nothing_has_no_mean():
    with pytest.raises(InputError, match="at least one value of age"):
        LEVELS["age"].scale.mean([])


def test_what_no_scale_knows_is_no_attribute():
    assert not hasattr(LEVELS["gender"].scale, "colour")


def test_a_scale_has_only_what_its_level_allows():
    education = load_rulebook("illustrative-levels").variables["education"].scale
    assert hasattr(education, "median")
    assert not hasattr(education, "mean")
