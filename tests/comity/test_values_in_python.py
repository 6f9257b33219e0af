"""What Comity's values are in Python and in a notebook: short, mappings or numbers where they are that."""

from __future__ import annotations

import sys
from html import unescape
from html.parser import HTMLParser
from importlib.metadata import version

import numpy
import pytest

import comity
from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario
from comity_fis import InputError, load_rulebook

A_FEW = 12


@pytest.fixture(scope="module")
def episode():
    return comity.run("two-visits")


@pytest.fixture(scope="module")
def inference():
    return comity.infer("arab_woman")


def shown_values():
    """One value of each kind that people look at, with what its `repr` must name."""
    inference = comity.infer("arab_woman")
    episode = comity.run("two-visits")
    return {
        "episode": (episode, ["two-visits", "success", "guest: greeted"]),
        "plan": (episode.prepared.plan, ["721", "Reach_user(robot, host, front)"]),
        "rulebook": (load_rulebook("bruno2017"), ["bruno2017", "20 rules", "gender", "approach_speed"]),
        "inference": (inference, ["bruno2017", "gender female", "conversational_distance: 0.6402 m"]),
        "number": (inference["conversational_distance"], ["0.6402 m", "culture"]),
        "word": (inference["greeting_gesture"], ["greeting_gesture: nod"]),
    }


class Reader(HTMLParser):
    """Whether all that opens closes."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs) -> None:
        self.open.append(tag)

    def handle_endtag(self, tag) -> None:
        assert self.open.pop() == tag


def test_the_package_says_its_version():
    assert comity.__version__ == version("comity")


def test_a_repr_is_a_few_lines_that_name_what_counts():
    for value, named in shown_values().values():
        assert len(repr(value).splitlines()) <= A_FEW
        assert all(word in repr(value) for word in named)


def test_a_notebook_shows_a_table_in_well_formed_html():
    for kind, (value, _) in shown_values().items():
        reader = Reader()
        reader.feed(value._repr_html_())
        assert reader.open == []
        assert ("<iframe" if kind == "episode" else "<table>") in value._repr_html_()


def test_a_long_plan_says_how_many_steps_are_not_shown():
    plan = comity.run("reception").prepared.plan
    assert f"and {len(plan.steps) - 8} more" in repr(plan)


def test_a_notebook_shows_the_page_that_the_run_folder_would_have(episode, here):
    record(prepare(load_scenario("two-visits")), out=here / "two-visits")
    shown = episode._repr_html_().partition('srcdoc="')[2].partition('" width')[0]
    assert unescape(shown) == (here / "two-visits" / "replay.html").read_text(encoding="utf-8")


def test_an_inference_is_a_mapping_of_parameters(inference):
    assert list(inference) == list(inference.parameters)
    assert dict(inference) == inference.parameters
    assert inference["greeting_gesture"].value == "nod"
    assert "pace" not in inference


def test_a_number_is_a_float_and_a_word_is_none(inference):
    assert float(inference["approach_speed"]) == inference["approach_speed"].value
    with pytest.raises(TypeError):
        float(inference["greeting_gesture"])


def test_a_profile_written_out_counts_as_one_in_a_file(here):
    (here / "agnes.profile.yaml").write_text("name: agnes\nculture: SWE\nage: 70\n")
    written = {"culture": "SWE", "age": 70}
    assert comity.infer(written) == comity.infer("agnes.profile.yaml")
    by_name, by_words = (
        comity.run("two-visits", profiles={"guest": profile}) for profile in ("agnes.profile.yaml", written)
    )
    assert by_words.trace_sha256 == by_name.trace_sha256
    assert by_words.prepared.profiles["guest"].name == "guest"


def test_a_run_with_a_profile_written_out_runs_again_from_its_folder(here):
    first = comity.run("johanna", profiles={"johanna": {"culture": "SWE", "age": 70}}, out="run")
    assert comity.run("run/scenario.yaml").trace_sha256 == first.trace_sha256


@pytest.mark.parametrize(
    ("written", "named"),
    [
        ({"agee": 70}, "age"),
        ({"age": -3}, "-3"),
        ({"age": print}, "built-in"),
        ({"settings": 3}, "3"),
        (7, "7"),
    ],
    ids=str,
)
def test_what_is_no_profile_is_refused_with_what_came(written, named):
    with pytest.raises(InputError, match=named):
        comity.infer(written)
    with pytest.raises(InputError, match=named):
        comity.run("johanna", profiles={"johanna": written})


@pytest.mark.parametrize("table", ["frames", "readings"])
def test_a_data_frame_holds_what_the_file_of_the_run_holds(table, here):
    pandas = pytest.importorskip("pandas")
    episode = comity.run("johanna", out="run")
    file = pandas.read_csv(f"run/{table}.csv")
    pandas.testing.assert_frame_equal(episode.to_frame(table), file, rtol=0.0, atol=1e-6)


def test_a_data_frame_of_events_has_a_row_for_each_change(episode):
    pytest.importorskip("pandas")
    events = episode.to_frame("events")
    assert list(events.t) == [event.t for event in episode.events]
    assert set(events.status) == {event.status for event in episode.events}


def test_a_table_that_an_episode_does_not_have_is_refused(episode):
    with pytest.raises(ValueError, match="expected frames, events or readings, got 'visits'"):
        episode.to_frame("visits")


def test_without_pandas_the_message_says_what_to_install(episode, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"comity\[pandas\]"):
        episode.to_frame()


@pytest.mark.parametrize("profile", [None, "german_woman", {"culture": "SWE"}])
def test_a_fact_that_no_variable_is_named_after_is_refused(profile):
    with pytest.raises(comity.InputError, match="individualism"):
        comity.infer(profile, individualsm=5)


def test_a_profile_written_out_may_hold_scalars_of_numpy():
    plain = comity.infer({"culture": "SWE", "age": 70, "settings": {"approach_speed": 0.3}})
    age, speed = numpy.int64(70), numpy.float64(0.3)
    assert comity.infer({"culture": "SWE", "age": age, "settings": {"approach_speed": speed}}) == plain


@pytest.mark.parametrize("seed", [-1, 1.5, "a", True, None])
def test_a_seed_that_is_none_is_refused(seed):
    with pytest.raises(comity.InputError, match="seed"):
        comity.run("johanna", seed=seed)


def test_what_the_functions_return_can_be_named():
    assert isinstance(comity.infer("german_woman"), comity.Inference)
    assert {"Episode", "Inference", "ParameterValue", "Plan", "Rulebook", "run"} <= set(dir(comity))
    assert all(hasattr(comity, name) for name in dir(comity))


def test_profiles_that_are_no_mapping_are_refused():
    with pytest.raises(comity.InputError, match="profiles by person"):
        comity.run("johanna", profiles="german_man")


def test_an_episode_can_be_kept_in_a_set(episode):
    assert episode in {episode}


@pytest.mark.parametrize(
    ("said", "keys"),
    [
        ({"culture": "JPM"}, "culture"),
        ({"gendr": "female"}, "gendr"),
        ({"settings": {"greeting_gesture": "kick"}}, "settings, greeting_gesture"),
    ],
)
def test_a_complaint_about_a_profile_written_out_names_its_keys_and_no_line(said, keys: str) -> None:
    with pytest.raises(InputError) as refused:
        comity.infer(said)
    assert (refused.value.where.file, refused.value.where.line) == (
        f"the profile of the person, {keys}",
        None,
    )
