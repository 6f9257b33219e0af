"""A study is checked whole before anything runs, and its plan says what will."""

from __future__ import annotations

import pytest
from study.writing import COMFORT, population, study

from comity.study.study_plan import load_study
from comity.study.tasks import task_of
from comity.study.worker import Installation, installation
from comity_fis import InputError

GROUPS = ("SWE", "DEU", "JPN", "IND", "EGY", "BRA")


def refused(path) -> InputError:
    with pytest.raises(InputError) as error:
        load_study(path)
    assert error.value.where is not None
    return error.value


def test_six_groups_of_thirty_with_ten_seeds_and_two_rulebooks_are_3600_episodes(here, comity):
    groups = {one: {"individuals": 30, "facts": {"culture": one}, "comfort": COMFORT} for one in GROUPS}
    population(here / "people.yaml", groups=groups)
    factors = {"rulebook": ["bruno2017", "evidence"], "robot.sensor.noise_m": [0.02]}
    study(here / "six.yaml", population="people.yaml", factors=factors, seeds=10)
    said = comity("study", "plan", "six.yaml", "--json")
    assert said.code == 0, said.err
    answer = said.json
    assert answer["episodes"] == 6 * 30 * 10 * 2
    assert answer["groups"] == dict.fromkeys(GROUPS, 30)
    assert answer["without_effect"] == []
    assert answer["estimated_s"] > 1
    assert answer["estimated_bytes"] > 3600 * 1000
    assert "no findings about people" in answer["statement"]
    assert sorted(path.name for path in here.iterdir()) == ["people.yaml", "six.yaml"]


def test_a_plan_says_where_seeds_change_nothing(here, comity):
    study(here / "quiet.yaml", factors={"robot.sensor.noise_m": [0, 0.02]}, seeds=3)
    answer = comity("study", "plan", "quiet.yaml", "--json").json
    assert answer["without_effect"] == ["johanna (robot.sensor.noise_m: 0)"]
    assert "Seeds change nothing" in comity("study", "plan", "quiet.yaml").out


def test_a_culture_without_a_score_is_noted_once_in_a_population_and_in_a_factor(here, comity):
    groups = {name: {"individuals": 3, "facts": {"culture": name}} for name in ("SWE", "INDD")}
    population(here / "people.yaml", groups=groups)
    factors = {"rulebook": ["bruno2017", "evidence"], "people.johanna.posture": ["seated", "standing"]}
    study(here / "s.yaml", population="people.yaml", factors=factors, seeds=2)
    (note,) = comity("study", "plan", "s.yaml", "--json").json["notes"]
    assert note.startswith("INDD: INDD ")
    assert comity("study", "run", "s.yaml", "--out", "out", "--jobs", 1, "--json").err.count("INDD: ") == 1
    profiles = [{"name": "j", "culture": one} for one in ("SWE", "GERM")]
    plan = load_study(study(here / "t.yaml", factors={"people.visited.profile": profiles}))
    (note,) = plan.notes
    assert note.startswith("johanna: GERM ")


def test_the_same_individuals_meet_every_condition(here):
    population(here / "people.yaml")
    plan = load_study(
        study(
            here / "s.yaml",
            population="people.yaml",
            factors={"rulebook": ["bruno2017", "evidence"]},
            seeds=2,
        )
    )
    met = {}
    for cell in plan.cells():
        met.setdefault(cell.condition.number, []).append((cell.individual, cell.seed))
    assert met[1] == met[2]
    assert len(met[1]) == 8


def test_a_role_is_the_person_of_each_scenario(here):
    plan = load_study(
        study(
            here / "s.yaml",
            scenarios=["johanna", "two-visits"],
            roles={"guest": {"johanna": "johanna", "two-visits": "guest"}},
            factors={"people.guest.posture": ["seated"], "people.visited.carrying": ["a bag"]},
        )
    )
    (alone,), (two,) = (plan.bases[name] for name in ("johanna", "two-visits"))
    assert alone.scenario["people"]["johanna"]["posture"] == "seated"
    assert two.scenario["people"]["guest"]["posture"] == "seated"
    assert two.scenario["people"]["host"]["carrying"] == "a bag"
    assert "carrying" not in two.scenario["people"]["guest"]


def test_a_key_depends_on_all_that_an_episode_does(here):
    """On factors, individual, seed, code and fingerprint; not on what others are called."""
    population(here / "people.yaml")
    keys = {"population": "people.yaml", "factors": {"robot.sensor.noise_m": [0, 0.02]}, "seeds": 2}
    plan = load_study(study(here / "s.yaml", **keys))
    known = [cell.key("code", "here") for cell in plan.cells()]
    assert len(set(known)) == plan.episodes
    assert not {*known} & {cell.key("other", "here") for cell in plan.cells()}
    assert not {*known} & {cell.key("code", "there") for cell in plan.cells()}
    wider = load_study(study(here / "t.yaml", **{**keys, "seeds": 3, "about": "Another word."}))
    assert {*known} < {cell.key("code", "here") for cell in wider.cells()}


def test_a_rulebook_beside_the_study_counts_by_its_content(here):
    from comity_fis import read_rulebook

    text = read_rulebook("evidence").text
    keys = []
    for added in ("", "# Only a comment.\n", "\n"):
        (here / "own.yaml").write_text(text + added, "utf-8")
        plan = load_study(study(here / "s.yaml", factors={"rulebook": ["own.yaml"]}))
        (cell,) = plan.cells()
        keys.append(cell.key("", ""))
    (here / "own.yaml").write_text(text.replace("0.3", "0.31", 1), "utf-8")
    (cell,) = load_study(here / "s.yaml").cells()
    assert keys[1] == keys[2]  # a rulebook of one's own counts without its comments
    assert cell.key("", "") not in keys


def test_what_workers_get_names_no_real_individual(here):
    (here / "people.csv").write_text("individual,culture\nAnna Berg,SWE\n", "utf-8")
    population(here / "people.yaml", groups={}, table="people.csv")
    plan = load_study(study(here / "s.yaml", population="people.yaml"))
    (cell,) = plan.cells()
    assert "Berg" not in repr(task_of(plan, cell, installation()))
    assert "Berg" not in repr(cell)


def test_installations_are_told_apart():
    assert installation() == installation()
    assert Installation("a", "b") != Installation("a", "c")


BROKEN = {
    "an unknown scenario": ({"scenarios": ["johana"]}, 4),
    "a scenario twice": ({"scenarios": ["johanna", "johanna"]}, 5),
    "a seed twice": ({"seeds": [4, 1, 1]}, 8),
    "an unknown key": ({"factors": {"rulebook": ["evidence"], "robot.sensor.nois_m": [0.02]}}, 9),
    "a value out of range": ({"factors": {"robot.sensor.noise_m": [0.02, 3]}}, 8),
    "an unknown rulebook": ({"factors": {"rulebook": ["evidnce"]}}, 7),
    "an unknown profile": ({"factors": {"people.visited.profile": ["arab_woman", "arab_wommn"]}}, 8),
    "nobody of that name": ({"factors": {"people.anna.posture": ["seated"]}}, 7),
    "a place in a wall": ({"factors": {"people.visited.at_m": [[5.0, 3.0], [50, 50]]}}, 9),
    "a role without a person": ({"roles": {"guest": {"two-visits": "guest"}}}, 6),
    "a role of nobody": ({"roles": {"guest": "gast"}}, 6),
    "no such population": ({"population": "nobody.yaml"}, 5),
    "a way through a number": ({"factors": {"robot.max_speed_m_s.x": [1]}}, 7),
}


SAID = {
    "people.nobody.posture": ("a person or a role", "'nobody'", ("johanna", "visited")),
    "changes.0.at_s": ("a list `changes` with an item 0", "no `changes`", ()),
}


@pytest.mark.parametrize(("path", "words"), SAID.items(), ids=SAID)
def test_a_path_that_leads_nowhere_is_refused_by_the_key_that_is_missing(here, path, words):
    error = refused(study(here / "s.yaml", factors={path: [1]}))
    expected, got, names = words
    assert (expected in error.expected, got in error.got) == (True, True)
    assert all(name in error.remedy for name in names)


@pytest.mark.parametrize(("keys", "line"), BROKEN.values(), ids=BROKEN)
def test_what_is_broken_is_refused_by_file_and_line(here, comity, keys, line):
    path = study(here / "s.yaml", **keys)
    error = refused(path)
    assert (error.where.file, error.where.line) == (str(path), line)
    for command in (["plan", "s.yaml"], ["run", "s.yaml", "--out", "there"])[:1]:
        said = comity("study", *command)
        assert said.code == 2
        assert said.err.startswith(f"comity: s.yaml:{line}: expected")
    assert not (here / "there").exists()


def test_a_factor_that_the_individuals_bring_along_is_refused(here):
    population(here / "people.yaml")
    factors = {"people.visited.profile": ["arab_woman"]}
    assert refused(study(here / "s.yaml", population="people.yaml", factors=factors)).where.line == 8


def test_comfort_from_a_rulebook_that_decides_in_the_study_needs_a_word(here):
    comfort = {"rulebook": "evidence", "source": "design choice"}
    population(here / "people.yaml", groups={"swedes": {"individuals": 2, "comfort": comfort}})
    keys = {"population": "people.yaml", "factors": {"rulebook": ["bruno2017", "evidence"]}}
    assert "judged" in refused(study(here / "s.yaml", **keys)).got
    assert load_study(study(here / "s.yaml", **keys, assume="rulebook")).episodes == 4
    keys["factors"] = {"rulebook": ["bruno2017"]}
    assert load_study(study(here / "s.yaml", **keys)).episodes == 2


def test_a_wish_that_a_rulebook_does_not_grant_is_refused_by_its_row(here):
    (here / "people.csv").write_text("individual,wish_m\nanna,0.9\nomar,0.1\n", "utf-8")
    population(here / "people.yaml", groups={}, table="people.csv", wishes="stated")
    error = refused(study(here / "s.yaml", population="people.yaml"))
    assert (error.where.file, error.where.line) == (str(here / "people.csv"), 3)


def test_facts_that_change_with_the_day_need_one(here):
    (here / "people.csv").write_text("individual,birth_year\nanna,1950\n", "utf-8")
    population(here / "people.yaml", groups={}, table="people.csv")
    assert "day" in refused(study(here / "s.yaml", population="people.yaml")).expected
    assert load_study(study(here / "s.yaml", population="people.yaml", at="2026-01-01")).episodes == 1


def test_a_stored_profile_is_refused(here, comity):
    comity("profile", "set", "amal", "culture=EGY")
    factors = {"people.visited.profile": ["amal"]}
    assert "stored profile amal" in refused(study(here / "s.yaml", factors=factors)).got
