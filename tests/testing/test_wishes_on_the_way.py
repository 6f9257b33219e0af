"""What people say on the way counts from then on: for the way, for the figures and for expectations."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from importlib import resources
from pathlib import Path

import pytest
from saved import saved

from comity.episode import Episode
from comity.testing.collection.cases import claims_in
from comity.testing.runner.telling import failure_text
from comity.testing.trials.attempt import attempted
from comity.testing.verdict import Failure, judged
from comity_fis import InputError

HALL = """\
schema_version: 1
name: hall
rulebook: {rulebook}
place: {{width_m: 14, height_m: {height_m}}}
robot: {{at_m: [1, 2.5]}}
people:
  guest: {{profile: german_woman, at_m: [13, 2], facing_deg: 180}}
  ines: {{profile: {ines}, at_m: [8, 1], facing_deg: 90}}
goals: [{goals}]
changes: [{changes}]
expect:
{sentences}
"""
INES = "{at_s: 1, person: ines, says: {conversational_distance: 2.8}}"
GUEST = "{at_s: 12, person: guest, says: {conversational_distance: 1.4, greeting_gesture: bow}}"
AFTERWARDS = "{at_s: 30, person: guest, says: {conversational_distance: 0.6}}"
USUAL = {
    "rulebook": "bruno2017",
    "height_m": 8,
    "ines": "arab_woman",
    "changes": INES,
    "goals": "greet: guest",
}
WISH = "schema_version: 1\nname: wish\nsettings: {conversational_distance: 2.8}\n"


@pytest.fixture
def hall(tmp_path: Path) -> Callable[..., Sequence]:
    """The tests of a hall with these changes and sentences."""

    def claims(*sentences: str, **otherwise: str | float):
        (tmp_path / "wish.profile.yaml").write_text(WISH)
        path = tmp_path / "hall.scenario.yaml"
        lines = "\n".join(f"  - {sentence}" for sentence in sentences or ["outcome is success"])
        path.write_text(HALL.format(**{**USUAL, "sentences": lines, **otherwise}))
        return claims_in(path)

    return claims


@pytest.fixture
def trial(hall) -> Callable[..., Episode]:
    return lambda **hall_with: attempted(hall(**hall_with)[0].case)


@pytest.fixture
def failures(hall) -> Callable[..., tuple[str, ...]]:
    """What is told of each sentence that does not hold, as people read it, by its line."""

    def told(*sentences: str, **hall_with) -> tuple[str, ...]:
        (claim,) = hall(*sentences, **hall_with)
        found: tuple[Failure, ...] = judged(claim).failures
        return tuple(" ".join(failure_text(claim, (each,)).split()) for each in found)

    return told


def test_a_bystander_who_asks_for_more_room_is_passed_as_if_it_stood_in_their_profile(trial):
    said, declared = trial(), trial(changes="", ines="wish.profile.yaml")
    unsaid = trial(changes="")
    ways = [each.metrics.path_length_m for each in (said, declared, unsaid)]
    assert ways[0] == pytest.approx(ways[1], rel=0.02)
    assert ways[0] > ways[2] + 2.0
    assert said.metrics.longest_intrusion_s == 0.0


def test_the_picture_has_the_distance_that_they_asked_for(hall, tmp_path):
    run = saved(hall()[0].case.path, tmp_path / "run")
    likes_m = {one.name: one.personal_distance_m for one in run.scene.people}
    assert likes_m["ines"] == 2.8


def test_where_there_is_no_room_the_figures_judge_by_what_they_asked_for(trial):
    """In a corridor nobody can be passed at 2.8 m."""
    said, unsaid = trial(height_m=4).metrics, trial(height_m=4, changes="").metrics
    assert unsaid.compliance_share["ines"] == 1.0
    assert said.compliance_share["ines"] < 0.8
    assert said.longest_intrusion_s > 5.0
    assert said.space_compliance_share < 0.8


def test_no_intrusion_is_judged_by_what_a_bystander_asked_for_and_names_it(failures):
    sentence = "longest_intrusion of ines at most 0.1 s"
    assert failures(sentence, height_m=4, changes="") == ()
    (told,) = failures(sentence, height_m=4)
    assert "longest_intrusion of ines at most 0.10 s" in told
    assert re.search(r"distance \d\.\d+ m at the nearest, their own 2.800 m", told)
    assert "held 0.640 m (culture) from the start" in told
    assert "held 2.800 m (setting) from t=1.00 s on: ines asked for conversational_distance 2.8" in told


def test_what_was_done_before_they_asked_is_no_intrusion(failures):
    """The robot has passed Ines when she asks for the room that it had taken."""
    late = INES.replace("at_s: 1,", "at_s: 40,")
    assert failures("longest_intrusion at most 0.1 s", height_m=4, changes=late) == ()


def test_a_way_that_is_longer_because_of_a_wish_names_it(failures):
    (told,) = failures("path_length at most 12 m")
    assert "goes by conversational_distance of ines 2.800 m, from t=1.00 s on: asked for" in told


def test_the_wanted_distance_is_that_of_the_time_of_docking(failures):
    sentence = "docking_error of guest at most 1 cm"
    assert failures(sentence, changes=f"{GUEST}, {AFTERWARDS}") == ()
    (told,) = failures("docking_error of guest at most 0.01 mm", changes=f"{GUEST}, {AFTERWARDS}")
    assert re.search(r"distance target 1\.40*\d* m, actual", told)
    assert "held 1.400 m (setting) from t=12.00 s on: guest asked for conversational_distance 1.4" in told


def test_a_parameter_is_that_with_which_the_visit_was_carried_out(failures):
    holding = (
        "conversational_distance of guest is 1.4 m within 1 mm",
        "conversational_distance of guest is decided by setting",
        "conversational_distance of guest is decided because 'asked for'",
        "greeting_gesture of guest is bow",
    )
    assert failures(*holding, changes=GUEST) == ()


def test_what_somebody_says_after_their_visit_does_not_change_how_it_was(failures):
    sentences = (
        "docking_error of ines at most 1 cm",
        "conversational_distance of ines is 64 cm within 1 cm",
    )
    both, late = "greet: ines, greet: guest", INES.replace("at_s: 1,", "at_s: 18,")
    (told,) = failures(*sentences, "docking_time of ines at most 1 s", goals=both, changes=late)
    assert "conversational_distance of ines 2.800 m, from t=18.00 s on" in told


@pytest.mark.parametrize(
    ("sentence", "start", "later", "counts"),
    [
        (
            "conversational_distance of guest is 85 cm within 1 cm",
            "0.847 m (culture)",
            "1.400 m (setting)",
            "when the robot had docked",
        ),
        ("greeting_gesture of guest is wave", "wave (culture)", "bow (setting)", "when guest was greeted"),
        (
            "greeting_gesture of guest is decided by culture",
            "wave (culture)",
            "bow (setting)",
            "when guest was greeted",
        ),
    ],
)
def test_a_failure_says_which_value_held_when_and_which_counts(failures, sentence, start, later, counts):
    (told,) = failures(sentence, changes=GUEST)
    assert f"held {start} from the start held {later} from t=12.00 s on: guest asked for" in told
    assert re.search(rf"counts what held at t=\S+ s, {counts}", told)


def test_in_a_long_visit_the_last_docking_counts_for_the_distance_and_not_for_the_gesture(failures):
    """She was greeted, and the robot is with her still, when she asks for more room and for a bow."""
    longer = "greet: guest}, {wait_s: 5, with: guest"
    late = GUEST.replace("at_s: 12", "at_s: 22")
    holding = (
        "docking_error of guest at most 1 cm",
        "conversational_distance of guest is 1.4 m within 1 mm",
        "chosen_distance of guest is 1.4 m within 1 mm",
        "greeting_gesture of guest is wave",
    )
    assert failures(*holding, goals=f"{{{longer}}}", changes=late) == ()


def test_of_somebody_who_is_not_visited_the_end_counts(failures):
    assert failures("conversational_distance of ines is 2.8 m within 1 mm") == ()
    (told,) = failures("conversational_distance of ines is 64 cm within 1 cm")
    assert "counts what held in the end" in told


def test_a_value_that_held_throughout_has_no_such_lines(failures):
    (told,) = failures("conversational_distance of guest is 64 cm within 1 cm")
    assert " held " not in told
    assert "counts" not in told


def test_a_wish_that_no_robot_can_keep_to_on_its_way_is_refused_with_its_line(hall, tmp_path):
    shipped = resources.files("comity_fis").joinpath("rulebooks", "bruno2017.yaml").read_text()
    (tmp_path / "far.yaml").write_text(shipped.replace("ask: [0.45, 3.0]", "ask: [0.45, 20]"))
    (claim,) = hall(changes=INES.replace("2.8", "12"), rulebook="far.yaml")
    with pytest.raises(InputError, match=r"hall\.scenario\.yaml:10: .*personal_distance_m"):
        attempted(claim.case)
