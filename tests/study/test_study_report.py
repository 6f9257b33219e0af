"""The report of a study says what its table has: levels, paired differences, and what stands out."""

from __future__ import annotations

import csv
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from study.writing import COMFORT, population, study
from terminal import signals_of_a_terminal

from comity.study import Study
from comity.study.report.answering import comparison_answer, comparison_named
from comity.study.report.episodes import StudyVisits
from comity.study.report.factors import factors_of_visits
from comity.study.report.group_differences import groups_figure
from comity.study.report.outcomes import outcomes_of, pictured
from comity.study.report.reporting import write_report
from comity.study.report.serving import served_worse, shortfalls, worst_served
from comity.study.report.telling import few_of
from comity.study.report.unusual import failures, outliers
from comity.study.running import run_study
from comity.study.statement import STATEMENT
from comity.study.study_plan import load_study
from comity_fis import InputError, Where

COLUMNS = (
    "row",
    "scenario",
    "condition",
    "rulebook",
    "rulebook_used",
    "group",
    "individual",
    "seed",
    "person",
)
MEASURED = {
    "trace_sha256": "",
    "noticed": "",
    "chosen_bearing_deg": "deg",
    "outcome": "",
    "distance_actual_m": "m",
    "comfort_gap_m": "m",
    "greeted_s": "s",
    "reason": "",
}
COMFORTS = {"distance_target_m": "m", "comfort_near_m": "m", "comfort_far_m": "m"}


def tabled(folder: Path, rows: list[dict[str, object]]) -> StudyVisits:
    """A study's folder with these visits; what is left out is empty."""
    folder.mkdir(exist_ok=True)
    names = (*COLUMNS, *MEASURED, *COMFORTS)
    with (folder / "dictionary.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("column", "unit", "definition", "source", "empty_because"))
        for name in names:
            is_factor = name == "rulebook"
            source = "the study's file" if name in COLUMNS else "Comity's own"
            means = "Factor: rulebook." if is_factor else name
            writer.writerow((name, {**MEASURED, **COMFORTS}.get(name, ""), means, source, ""))
    with (folder / "results.csv").open("w", newline="") as file:
        table = csv.DictWriter(file, names, restval="")
        table.writeheader()
        table.writerows(rows)
    return StudyVisits.of(Study.load(folder)) if rows else None


def visits(folder, distance, *, people=4, seeds=2, **more):
    """Individuals of two groups x two rulebooks x seeds; distances by a function of all."""
    rows = []
    for i, book in enumerate(("a", "b")):
        for person in range(people):
            for seed in range(seeds):
                row = {
                    "row": len(rows) + 1,
                    "scenario": "room",
                    "condition": i + 1,
                    "rulebook": book,
                    "rulebook_used": book,
                    "group": "near" if person < people / 2 else "far",
                    "individual": f"p{person}",
                    "seed": seed,
                    "person": "x",
                    "outcome": "greeted",
                    "distance_actual_m": distance(i, person, seed),
                }
                rows.append({**row, **{key: value(row) for key, value in more.items()}})
    return tabled(folder, rows)


def compared(found, *names):
    one = comparison_named(found, factors_of_visits(found), *names)
    outcomes = pictured(outcomes_of(found), ["distance_actual_m"])
    return comparison_answer(found, one, outcomes, "s")


def test_a_difference_is_taken_within_the_same_individual_and_seed(tmp_path):
    """Individuals lie metres apart; the rulebook adds 0.1 m to each, the second seed a centimetre more.

    So the interval is that of the two seeds alone.
    """
    found = visits(tmp_path, lambda book, person, seed: 2 * person + book * (0.1 + 0.01 * seed))
    answer = compared(found, "rulebook", "a", "b")
    one = answer.differences[0]
    assert (answer.pairs, one.difference.episodes) == (8, 8)
    assert one.second - one.first == pytest.approx(0.105)
    ends = (one.difference.mean, one.difference.low, one.difference.high)
    assert ends == pytest.approx((0.105, 0.1, 0.11))
    assert one.difference.monte_carlo_error == pytest.approx(0.005)
    assert [one.group for one in answer.differences] == [None, "near", "far"]


def test_few_to_resample_are_the_individuals_of_the_smallest_group_and_the_seeds(tmp_path):
    many = visits(tmp_path / "many", lambda *some: sum(some), people=20, seeds=10)
    few = visits(tmp_path / "few", lambda *some: sum(some), people=18, seeds=3)
    differences = [
        [one.difference for one in compared(found, "rulebook", "a", "b").differences] for found in (many, few)
    ]
    assert [few_of(some) for some in differences] == [{}, {"individuals": 9, "seeds": 3}]
    assert few_of(differences[1][:1]) == {"seeds": 3}


def test_the_figure_by_group_draws_the_differences_and_intervals_of_the_comparison(tmp_path):
    found = visits(tmp_path, lambda book, person, seed: book * (person + seed))
    answer = compared(found, "rulebook", "a", "b")
    (panel,) = groups_figure(answer).axes
    zero, *drawn = [[float(x) for x in line.get_xdata()] for line in panel.lines]
    told = [one.difference for one in answer.differences]
    assert zero == [0, 0]
    assert drawn == [part for one in told for part in ([one.low, one.high], [one.mean])]
    assert [tick.get_text() for tick in panel.get_yticklabels()] == ["all", "near", "far"]


def test_comparing_the_other_way_round_turns_the_sign(tmp_path):
    found = visits(tmp_path, lambda book, person, seed: book * (1 + person))
    there, back = (compared(found, "rulebook", *two).differences[0].difference for two in ("ab", "ba"))
    assert (back.mean, back.low, back.high) == pytest.approx((-there.mean, -there.high, -there.low), abs=1e-9)


def test_a_factor_is_named_as_the_study_writes_it_or_as_its_column(tmp_path):
    found = visits(tmp_path, lambda book, person, seed: book)
    names = tmp_path / "dictionary.csv", tmp_path / "results.csv"
    for path in names:
        path.write_text(re.sub(r"\brulebook\b", "robot_rule_book", path.read_text()))
    found = StudyVisits.of(Study.load(tmp_path))
    by_path, by_column = (compared(found, name, "a", "b") for name in ("robot.rule_book", "robot_rule_book"))
    assert by_path == by_column
    assert by_path.pairs == 8


def test_a_table_without_rows_is_refused(comity, here):
    tabled(here / "s", [])
    words = (["report", "s"], ["compare", "s", "--factor", "rulebook", "a", "b"])
    for said in (comity("study", *some) for some in words):
        assert (said.code, "without rows" in said.err) == (2, True)


def test_a_group_is_served_worse_by_the_parameter_that_is_aimed_elsewhere(tmp_path):
    """The far group likes 1.2 m; the robot aims at 0.8 m and reaches what it aims at."""

    def near_m(row):
        return 0.7 if row["group"] == "near" else 1.2

    found = visits(
        tmp_path,
        lambda book, person, seed: 0.8,
        distance_target_m=lambda row: 0.8,
        comfort_near_m=near_m,
        comfort_far_m=lambda row: near_m(row) + 0.2,
        comfort_gap_m=lambda row: min(0.8 - near_m(row), 0),
    )
    group = next(one for one in factors_of_visits(found) if one.name == "group")
    worse = list(served_worse(shortfalls(found, group)))
    assert {(one.parameter, one.worst) for one in worse} == {("conversational_distance", "far")}
    assert all(one.told_apart and one.worst_missed == pytest.approx(0.4) for one in worse)
    assert {one.individual for one in worst_served(found, 9)} == {"p2", "p3"}


def test_failures_are_all_visits_without_a_greeting_that_nobody_declined(tmp_path):
    said = {1: "unreached", 2: "declined", 3: "error"}
    found = visits(tmp_path, lambda *_: 1, outcome=lambda row: said.get(row["row"], "greeted"))
    assert [(one.row, one.what) for one in failures(found.study)] == [(1, "unreached"), (3, "error")]


def test_a_pose_in_which_a_person_left_the_robot_is_no_choice(tmp_path):
    """One of two turns away by 60 degrees, which is no bearing that the robot chose."""
    found = visits(
        tmp_path,
        lambda *_: 1.0,
        noticed=lambda row: "turn_away" if row["seed"] else "ask_closer",
        chosen_bearing_deg=lambda row: 60.0 if row["seed"] else float(row["condition"]),
    )
    values = outcomes_of(found)["chosen_bearing_deg"].values
    assert sorted(values[~np.isnan(values)]) == [1.0] * 4 + [2.0] * 4


def test_an_outlier_is_unlike_the_other_seeds_of_its_individual(tmp_path):
    """Rulebooks are a metre apart and people a decimetre, which is no outlier; one seed of one person is."""
    found = visits(
        tmp_path,
        lambda book, person, seed: 9.0 if (book, person, seed) == (0, 3, 2) else book + person / 10,
        seeds=5,
    )
    assert [(one.individual, one.seed) for one in outliers(found, pictured(outcomes_of(found), ()))] == [
        ("p3", "2")
    ]


def test_outliers_with_the_same_trace_stand_once_with_how_many_share_it(tmp_path):
    """Under the fifth seed the robot does the same before all four individuals, at either rulebook."""
    found = visits(
        tmp_path,
        lambda book, person, seed: 9.0 + book if seed == 4 else book + person / 10,
        seeds=5,
        trace_sha256=lambda row: f"{row['rulebook']} at 4" if row["seed"] == 4 else str(row["row"]),
    )
    listed = outliers(found, pictured(outcomes_of(found), ()))
    assert sorted((one.condition, one.seed, one.alike) for one in listed) == [("1", "4", 4), ("2", "4", 4)]


def test_without_repeats_an_outlier_is_unlike_the_others_in_its_room(tmp_path):
    found = visits(
        tmp_path, lambda book, person, seed: 9.0 if person == 7 else person / 10, seeds=1, people=12
    )
    assert {one.individual for one in outliers(found, pictured(outcomes_of(found), ()))} == {"p7"}


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """The folder of a study of eight episodes, carried out in this process."""
    from comity.study.carrying import Ended, EpisodeRunner
    from comity.study.worker import carried_out, installation

    base = tmp_path_factory.mktemp("ran")
    groups = {
        name: {"individuals": 1, "facts": {"culture": culture, "gender": "female"}, "comfort": COMFORT}
        for name, culture in (("swedish", "SWE"), ("egyptian", "EGY"))
    }
    population(base / "people.yaml", groups=groups)
    factors = {"rulebook": ["bruno2017", "evidence"], "robot.sensor.noise_m": [0.02]}
    plan = load_study(study(base / "two.yaml", population="people.yaml", factors=factors, seeds=2))

    def carry_out(tasks):
        yield from (Ended((carried_out(task),)) for task in tasks)

    run_study(plan, base / "out", lambda: EpisodeRunner(installation(), carry_out), lambda *_: lambda _: None)
    return base / "out"


def report(comity, ran, *words):
    said = comity("study", "report", ran, *words, "--json")
    assert said.code == 0, said.err
    return said.json


def test_a_report_is_a_page_with_its_figures_as_svg_and_pdf_the_same_each_time(comity, here, ran):
    answers = [report(comity, ran, "--out", here / name) for name in ("one", "two")]
    files = [
        {path.relative_to(here / name): path.read_bytes() for path in (here / name).rglob("*.*")}
        for name in ("one", "two")
    ]
    assert files[0] == files[1]
    assert set(map(Path, answers[0]["figures"])) == set(files[0]) - {Path("index.html")}
    assert {path.suffix for path in files[0]} == {".html", ".svg", ".pdf"}
    page = files[0][Path("index.html")].decode()
    assert page.count(f">{STATEMENT}</p>") == 2
    assert not re.search(r'(?:src|href)="(?!#|data:|figures/)', page)


def test_ids_in_a_page_come_up_once(comity, here, ran):
    report(comity, ran, "--out", here / "r")
    ids = re.findall(r'\bid="([^"]+)"', (here / "r/index.html").read_text())
    assert len(ids) == len(set(ids))


def test_a_row_is_played_again_to_the_same_digest(comity, here, ran):
    rows = Study.load(ran).rows
    answer = comity("study", "show", ran, "--row", 6, "--out", here / "six", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["same"]
    assert answer.json["differs"] is None
    assert answer.json["trace_sha256"] == rows[5]["trace_sha256"]
    assert (here / "six/replay.html").is_file()


def test_a_row_under_another_rulebook_is_another_episode_and_ends_with_1(comity, here, ran):
    changed = here / "two.yaml"
    changed.write_text((ran.parent / "two.yaml").read_text().replace("- bruno2017", "- johanna-none"))
    (here / "people.yaml").write_text((ran.parent / "people.yaml").read_text())
    said = comity("study", "show", ran, "--row", 1, "--study", changed)
    assert said.code == 2
    changed.write_text((ran.parent / "two.yaml").read_text().replace("0.02", "0.05"))
    said = comity("study", "show", ran, "--row", 1, "--study", changed, "--out", here / "r", "--json")
    assert said.code == 1
    assert not said.json["same"]
    assert "changed" in said.json["differs"]


def _cut(text):
    return text[: text.index("\n", 30) + 40]


DAMAGED = [
    ("results.csv", _cut, 2),
    ("results.csv", lambda text: text.replace(",0.8,", ",abc,"), 2),
    ("results.csv", lambda text: text.replace(",0.8,", ",nan,"), 2),
    ("results.csv", lambda text: text.replace("distance_actual_m", "distance"), 1),
    ("results.csv", lambda text: text.replace("\n2,", "\n\n2,"), 3),
    ("results.csv", lambda text: text.replace("room", "ro\udcffm"), None),
    ("dictionary.csv", lambda text: text.replace("column", "col"), 1),
    ("dictionary.csv", _cut, 3),
]


@pytest.mark.parametrize(("name", "damage", "line"), DAMAGED)
def test_a_damaged_table_is_refused_by_file_and_line(tmp_path, name, damage, line):
    visits(tmp_path, lambda *_: 0.8)
    path = tmp_path / name
    path.write_text(damage(path.read_text()), errors="surrogateescape")
    with pytest.raises(InputError) as refused:
        Study.load(tmp_path)
    assert refused.value.where == Where(str(path), line)


def test_what_was_played_again_is_linked(comity, here, ran):
    assert comity("study", "show", ran, "--row", 1, "--out", here / "r/episodes/row-1").code == 0
    (here / "r/index.html").unlink(missing_ok=True)
    answer = report(comity, ran, "--out", here / "r", "--play", 1)
    linked = [one["page"] for one in answer["first_failures"] + answer["farthest_outliers"] if one["page"]]
    assert all((here / "r" / page).is_file() for page in linked)


STOPPED_REPORT = """
import os, runpy, sys
def stop(event, of):
    if event == {event!r} and str(of[0]).endswith({ending!r}):
        os.kill(os.getpid(), {number:d})
sys.addaudithook(stop)
sys.argv = {argv!r}
runpy.run_module("comity", run_name="__main__")
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize(
    ("event", "ending"), [("open", ".pdf"), ("os.rename", ".part.index.html"), ("os.rename", "/r")]
)
@pytest.mark.parametrize("older", [False, True])
def test_a_report_that_is_stopped_leaves_nothing_and_an_older_one_as_it_was(
    event, ending, number, older, tmp_path
):
    """In the first figure, before the page has its name, and before the folder has it."""
    visits(tmp_path / "s", lambda book, person, seed: book * (person + seed))
    if older:
        write_report(Study.load(tmp_path / "s"), tmp_path / "r", (), lambda rows: {})
        ending = "/index.html" if ending == "/r" else ending
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    argv = ["comity", "study", "report", "s", "--out", "r", "--outcome", "distance_actual_m"]
    code = STOPPED_REPORT.format(event=event, ending=ending, number=number, argv=argv)
    with signals_of_a_terminal():
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False
        )
    assert (done.returncode, done.stderr) == (128 + number, "comity: interrupted\n")
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before
    assert (tmp_path / "r").exists() == older


def test_a_report_takes_the_place_of_an_older_one_and_keeps_what_was_played_again(tmp_path):
    visits(
        tmp_path / "s", lambda book, person, seed: book * (person + seed), greeted_s=lambda row: row["seed"]
    )
    found = Study.load(tmp_path / "s")
    write_report(found, tmp_path / "r", ["distance_actual_m"], lambda rows: {})
    played = tmp_path / "r/episodes/row-1/run.json"
    played.parent.mkdir(parents=True)
    played.write_text("{}")
    answers = [write_report(found, tmp_path / name, ["greeted_s"], lambda rows: {}) for name in ("r", "new")]
    files = [
        {path.relative_to(tmp_path / name): path.read_bytes() for path in (tmp_path / name).rglob("*.*")}
        for name in ("r", "new")
    ]
    assert answers[0].figures == answers[1].figures
    assert files[0].pop(Path("episodes/row-1/run.json")) == b"{}"
    assert files[0] == files[1]


WRONG = [
    ("report", "nowhere"),
    ("report", "RAN", "--outcome", "outcome"),
    ("report", "RAN", "--out", "taken"),
    ("compare", "RAN", "--factor", "group", "swedish", "egyptian"),
    ("compare", "RAN", "--factor", "rulebook", "bruno2017", "bruno"),
    ("compare", "RAN", "--factor", "rulebook", "bruno2017", "bruno2017"),
    ("show", "RAN", "--row", "0"),
    ("show", "RAN", "--row", "9"),
    ("show", "RAN", "--row", "1", "--study", "none.yaml"),
]


@pytest.mark.parametrize("words", WRONG)
def test_what_cannot_be_shown_is_refused(comity, here, ran, words):
    (here / "taken").mkdir()
    (here / "taken/thesis.txt").write_text("mine")
    said = comity("study", *(ran if word == "RAN" else word for word in words))
    assert said.code == 2
    assert said.err.startswith("comity: ")
    assert [path.name for path in (here / "taken").iterdir()] == ["thesis.txt"]


def test_two_rulebooks_are_compared_side_by_side(comity, ran):
    said = comity("study", "compare", ran, "--factor", "rulebook", "bruno2017", "evidence", "--json")
    assert said.code == 0, said.err
    rows = Study.load(ran).rows
    one = next(one for one in said.json["differences"] if one["outcome"] == "distance_actual_m")
    means = [
        sum(float(row["distance_actual_m"]) for row in rows if row["rulebook"] == book) / 4
        for book in ("bruno2017", "evidence")
    ]
    assert [one["first"], one["second"]] == pytest.approx(means)
    assert said.json["statement"] == STATEMENT


def test_a_study_of_one_visit_has_a_report(tmp_path):
    """Nothing differs and nothing can be resampled: the page says so."""
    row = {"row": 1, "scenario": "room", "condition": 1, "rulebook_used": "a", "seed": 0, "person": "x"}
    tabled(tmp_path / "s", [{**row, "outcome": "greeted", "distance_actual_m": 0.8}])
    answer = write_report(Study.load(tmp_path / "s"), tmp_path / "r", (), lambda rows: {})
    (one,) = (one for one in answer.levels if one.outcome == "served_share")
    assert (one.level, one.estimate.mean, one.estimate.low) == ("all", 1, None)
    assert (answer.comparisons, answer.shortfalls, answer.served_worse) == ((), (), ())
