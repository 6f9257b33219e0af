"""Planning a scenario: what the moment rules out, why a plan is so, and why there is none."""

from __future__ import annotations

import random

import pytest
import yaml

from comity.answers.plan import StepAnswer, WhyAnswer
from comity.preparation import prepare
from comity.report.plans.asked_step import asked_step
from comity.report.plans.plan_diff import plan_diff
from comity.report.values.inference import because
from comity.scenario import load_scenario
from comity.system.library import shipped
from comity_fis import InputError

CULTURES = ("arab_woman", "german_woman", "arab_man", "german_man", "japanese_woman", "indian_man", "unknown")

PARTY = """
schema_version: 1
name: party
place: {width_m: 9.0, height_m: 7.0}
robot: {at_m: [1.0, 1.0], carrying: a tray}
people:
  anna: {profile: german_woman, at_m: [6.5, 5.0], facing_deg: 220}
  ben: {profile: german_man, at_m: [7.3, 4.2], facing_deg: 200}
  yumi: {profile: japanese_woman, at_m: [2.0, 5.5], facing_deg: -60, noisy: true}
  omar: {profile: german_host, at_m: [7.5, 1.2], facing_deg: 170}
groups: {window: [anna, ben]}
goals:
  - greet: anna
  - greet: ben
  - {greet: yumi, priority: 2}
  - {greet: omar, by_s: 60}
"""


@pytest.fixture
def written(here):
    """Write the party with changes, by path: `written({"place.noisy": True})`."""

    def write(changes=None, text=PARTY):
        content = yaml.safe_load(text)
        for path, value in (changes or {}).items():
            *parents, last = path.split(".")
            place = content
            for key in parents:
                place = place[int(key)] if isinstance(place, list) else place[key]
            place[last] = value
        (here / "party.scenario.yaml").write_text(yaml.safe_dump(content, sort_keys=False))
        return "party.scenario.yaml"

    return write


def greeting(answer, person):
    return next(
        step for step in answer["steps"] if person in step["people"] and step["action"] != "Reach_user"
    )


HERE = {"touch_consent": "given"}
"""Said in this meeting."""


def test_hands_noise_and_company_decide_the_greetings(comity, written):
    answer = comity("plan", written({"people.omar.situation": HERE}), "--json").json
    assert greeting(answer, "yumi")["arguments"][2:] == ["gestural", "nod"]
    together = greeting(answer, "anna")
    assert together["action"] == "Greet_company"
    assert sorted(together["people"]) == ["anna", "ben"]
    assert answer["optimal"]
    assert answer["gap"] == 0
    reasons = {tuple(o["arguments"][2:]): o["reason"] for o in greeting(answer, "omar")["why"]["ruled_out"]}
    assert reasons["both", "handshake"] == "the robot carries a tray"


def test_a_side_is_ruled_out_with_what_is_in_the_way(comity, written):
    """The crate by its name, the person by theirs; and where nothing stands, that no route leads there."""
    text = """
schema_version: 1
name: party
place:
  width_m: 8.0
  height_m: 6.0
  furniture: [{name: crate, box_m: [1.95, 3.55, 0.3, 0.3]}]
robot: {at_m: [1.0, 5.0]}
people:
  anna: {profile: german_woman, at_m: [3.0, 3.0], facing_deg: 180}
  ben: {profile: german_man, at_m: [2.1, 2.4], facing_deg: 180}
goals: [{greet: anna}]
"""
    (reach, _) = comity("plan", written(text=text), "--json").json["steps"]
    reasons = {out["arguments"][-1]: out["reason"] for out in reach["why"]["ruled_out"]}
    assert reasons == {
        "right": "no free place there: the crate is in the way",
        "left": "no free place there: ben is in the way",
    }


def test_a_group_is_greeted_at_once_in_the_world(comity, written):
    """Two are greeted by one utterance, and both count."""
    answer = comity("run", written(), "--json").json
    assert answer["outcome"] == "success"
    visits = {visit["person"]: visit for visit in answer["visits"]}
    (follower,) = [visit for visit in visits.values() if visit["together_with"]]
    assert {follower["person"], follower["together_with"]} == {"anna", "ben"}
    assert follower["outcome"] == "greeted"


LEAVES = """\
schema_version: 1
name: leaves
place: {width_m: 7.0, height_m: 5.5}
robot: {at_m: [0.8, 0.8]}
people:
  ada: {profile: german_woman, at_m: [3.4, 3.8], facing_deg: -30}
  ben: {profile: arab_man, at_m: [4.8, 3.8], facing_deg: 210}
  cyd: {profile: unknown, at_m: [4.1, 2.5], facing_deg: 90}
groups: {talk: [ada, ben, cyd]}
goals: [{greet: ada}, {greet: cyd}]
changes: [{at_s: 1, person: cyd, moves_to_m: [6.0, 1.2], facing_deg: 160}]
"""


def test_who_has_left_a_group_is_not_greeted_with_it(comity, tmp_path):
    """Although they would see and hear the robot from there."""
    (tmp_path / "leaves.scenario.yaml").write_text(LEAVES)
    answer = comity("run", str(tmp_path / "leaves.scenario.yaml"), "--json").json
    visits = {visit["person"]: visit for visit in answer["visits"]}
    assert {name: visit["outcome"] for name, visit in visits.items()} == {"ada": "greeted", "cyd": "greeted"}
    assert not any(visit["together_with"] for visit in visits.values())


def test_a_deadline_that_is_planned_is_kept_in_the_world(comity, written):
    """The reckoning is late rather than early, whatever the culture."""
    name = written({"goals.3.by_s": 40.0})
    for culture in ("arab_woman", "german_man"):
        answer = comity("run", name, "--as", f"omar={culture}", "--json").json
        visit = next(visit for visit in answer["visits"] if visit["person"] == "omar")
        assert visit["docked_at_s"] + 4.0 <= 40.0


def test_a_deadline_holds_for_somebody_before_whom_the_usual_places_are_taken(comity, tmp_path):
    """By the window of the living room, between plant and chair, there is only room beside them."""
    (tmp_path / "corner.scenario.yaml").write_text(
        "schema_version: 1\nname: corner\nplace: {map: living-room}\nrobot: {at: door}\n"
        "people:\n  guest: {at: window}\n  host: {at_m: [4.2, 3.5], facing_deg: 200}\n"
        "goals:\n  - greet: host\n  - {greet: guest, by_s: 40}\n"
    )
    answer = comity("plan", str(tmp_path / "corner.scenario.yaml"), "--json").json
    reached = {step["arguments"][1] for step in answer["steps"] if step["action"] == "Reach_user"}
    assert reached == {"guest", "host"}


CORRIDOR = """\
schema_version: 1
name: corridor
place: {width_m: 11, height_m: 5}
robot: {at_m: [0.6, 2.5]}
people:
  mid: {at_m: [4, 2.5], facing_deg: 180}
  end: {at_m: [9, 2.5], facing_deg: 180}
goals:
  - greet: mid
  - {greet: end, GOAL}
"""


@pytest.mark.parametrize(
    "goal", [*(f"skip: {5 + i / 5:g}" for i in range(8)), *(f"by_s: {s}" for s in (22, 24, 26))]
)
def test_who_is_served_does_not_hang_on_how_far_somebody_beside_the_way_likes_to_be_passed(
    comity, here, goal
):
    """The real way bends around mid, more for some; the ways that decide do not."""
    (here / "corridor.yaml").write_text(CORRIDOR.replace("GOAL", goal))
    served = set()
    for profile in ("german_man", "arab_woman", "unknown"):
        answer = comity("plan", "corridor.yaml", "--as", f"mid={profile}", "--json").json
        served.add(tuple(step["people"][0] for step in answer["steps"] if step["action"] == "Greet_person"))
    assert len(served) == 1


def test_what_somebody_else_first_would_cost_leaves_out_who_is_left_out(comity, here):
    """The price of a skipped visit is in the plan's cost, and would be in the other's too."""
    text = CORRIDOR.replace("GOAL", "skip: 1").replace("people:\n", "people:\n  near: {at_m: [2.5, 4.2]}\n")
    (here / "corridor.yaml").write_text(text.replace("goals:\n", "goals:\n  - greet: near\n"))
    answer = comity("plan", "corridor.yaml", "--why", "1", "--json").json
    assert any(step["action"] == "Skip_visit" for step in answer["steps"])
    assert all(other["extra_cost"] >= 0 for other in answer["why"]["next_instead"])
    assert answer["why"]["next_instead"]


def test_one_step_says_all_about_itself(comity, written):
    name = written()
    answer = comity("plan", name, "--why", "Reach_user(omar)", "--json").json
    why = answer["why"]
    assert why["step"] == answer["steps"][why["number"] - 1]
    assert sum(why["step"]["cost_parts"].values()) == why["step"]["cost"]
    assert all(each["because"] for each in why["step"]["why"]["alternatives"])
    text = comity("plan", name, "--why", why["number"]).out
    assert "Somebody else first" in text or why["number"] == len(answer["steps"]) - 1


def test_an_unknown_step_is_refused_with_the_nearest(comity, written):
    said = comity("plan", written(), "--why", "Greet_person(oma)")
    assert said.code == 2
    assert "Did you mean 'Greet_person(omar)'?" in said.err


def test_a_difference_names_parameters_choices_and_rules(comity):
    answer = comity("plan", "two-visits", "--as", "guest=german_man", "--diff", "--json").json["diff"]
    changed = {change["parameter"] for change in answer["parameters"]}
    assert {"conversational_distance", "greeting_modality"} <= changed
    assert {change["person"] for change in answer["parameters"]} == {"guest"}
    assert all("rule" in change["because_after"] for change in answer["parameters"])
    assert [(c["before"], c["after"]) for c in answer["choices"] if c["action"] == "greeting"] == [
        (["both", "nod"], ["verbal", "none"])
    ]


@pytest.mark.parametrize(
    ("asked", "number"),
    [
        ("2", 2),
        ("Greet_person(omar)", 2),
        ("greet_person( Omar )", 2),
        ("Greet_person(robot, omar, verbal, none)", 2),
        ("Greet_company", 4),
        ("Greet_company(window)", 4),
        ("Greet_person(anna)", 4),
        ("Greet_person(ben)", 4),
        ("anna", 4),
        ("Skip_visit", 5),
    ],
)
def test_a_step_goes_by_whatever_names_it_alone(asked, number):
    """Its number, its action, its person, or any of its arguments; a company's greeting by each member."""
    assert asked_step(STEPS, asked, _name) == number


@pytest.mark.parametrize(
    ("asked", "remedy"),
    [
        ("Reach_user", "Say which: 1 is Reach_user(omar), 3 is Reach_user(ben)."),
        ("omar", "Say which: 1 is Reach_user(omar), 2 is Greet_person(omar)."),
        ("Reach_user(anna)", "Step 4 is for them: Greet_company(ben)."),
        ("Greet_person(oma)", "Did you mean 'Greet_person(omar)'?"),
        ("0", "Known are: "),
        ("6", "Known are: "),
        ("", "Known are: "),
        ("((", "Known are: "),
    ],
)
def test_what_names_no_step_or_several_says_which_there_are(asked, remedy):
    with pytest.raises(InputError) as refusal:
        asked_step(STEPS, asked, _name)
    assert remedy in str(refusal.value)


def _step(action: str, *arguments: str, people: tuple[str, ...]) -> StepAnswer:
    nothing = {"parameters": {}, "cost": 0, "cost_parts": {}, "from_": None}
    why = WhyAnswer(text="", alternatives=(), ruled_out=())
    return StepAnswer(action=action, arguments=("robot", *arguments), people=people, why=why, **nothing)


def _name(step: StepAnswer) -> str:
    return f"{step.action}({step.arguments[1]})"


STEPS = (
    _step("Reach_user", "omar", "front", people=("omar",)),
    _step("Greet_person", "omar", "verbal", "none", people=("omar",)),
    _step("Reach_user", "ben", "left", people=("ben",)),
    _step("Greet_company", "ben", "window", "both", "nod", people=("ben", "anna")),
    _step("Skip_visit", "far", people=("far",)),
)


@pytest.mark.parametrize("skip", [1.0, 4.0, 5.9])
def test_a_skipped_visit_has_its_price_and_what_serving_would_have_cost(comity, written, skip):
    """The path to the far corner is 6 m for everyone: any price below leaves them out."""
    text = shipped("scenario")["skipped-guest"].read_text().replace("skip: 4", f"skip: {skip}")
    name = written(text=text)
    for profile in ("arab_woman", "german_man"):
        said = comity("plan", name, "--why", "Skip_visit", "--as", f"far={profile}", "--json").json["why"]
        assert said["skipping"] == {"price": round(100 * skip), "serving": 600, "reason": None}
    text = " ".join(comity("plan", name, "--why", "Skip_visit").out.split())
    assert f"would cost 600 cm of path, {600 - round(100 * skip)} more than the price" in text


def test_whoever_is_skipped_because_no_plan_serves_them_says_what_keeps_them(comity, written):
    name = written({"people.yumi.profile": WISH, "goals.2.skip": 5})
    said = comity("plan", name, "--why", "yumi", "--json").json["why"]["skipping"]
    assert (said["price"], said["serving"]) == (500, None)
    assert "no greeting is possible for yumi" in said["reason"]


@pytest.mark.parametrize(
    ("scenario", "profiles"),
    [
        ("two-visits", {"guest": "german_man"}),
        ("comity-bench-1/busy-reception", {"guest": "german_woman", "friend": "arab_man"}),
        ("bystander", {"sam": "indian_man"}),
        ("tea-visit", {"anna": "german_man", "omar": "japanese_woman"}),
        ("party", {"omar": "own_wish", "yumi": "arab_man"}),
        ("party", {"ben": "arab_man", "anna": "own_wish"}),
    ],
)
def test_every_centimetre_of_a_difference_is_accounted_for(written, scenario, profiles):
    """What steps cost more or less adds up to the plans' difference, and each part says why."""
    file = load_scenario(written() if scenario == "party" else scenario)
    before, after = prepare(file), prepare(file, profiles=profiles)
    diff = plan_diff(before, after)
    assert diff.costs
    assert sum(step.cost[1] - step.cost[0] for step in diff.costs) == after.plan.cost - before.plan.cost
    for step in diff.costs:
        assert sum(part.after - part.before for part in step.parts) == step.cost[1] - step.cost[0]
        assert all(part.because and part.before != part.after for part in step.parts)


def test_a_step_that_is_the_same_but_dearer_says_which_parameter_made_it_so(comity):
    """Nobody's choices change, and the ways do: to whom likes more room, and past them."""
    diff = comity("plan", "bystander", "--as", "sam=arab_man", "--diff", "--json").json["diff"]
    (step,) = diff["costs"]
    assert step["before"] == step["after"] == ["robot", "guest", "front"]
    (part,) = step["parts"]
    assert part["part"] == "travel"
    assert part["because"] == "past sam, who likes to be passed at 1.091 m, and now at 0.875 m"
    text = comity("plan", "changes-her-mind", "--as", "host=arab_woman", "--diff").out
    assert "What costs more or less, +36 in all" in text
    assert "travel 393 → 411: to host: conversational distance 0.825 m → 0.640 m" in text
    assert "now, both with nod: desirability 0.84 as a greeting (modality: rule 11" in " ".join(text.split())


def test_the_same_profile_differs_in_nothing(comity):
    diff = comity("plan", "two-visits", "--as", "guest=arab_woman", "--diff", "--json").json["diff"]
    assert diff["parameters"] == diff["choices"] == diff["costs"] == []
    assert diff["cost"][0] == diff["cost"][1]
    assert comity("plan", "two-visits", "--diff").code == 2


def test_stability_is_reported(comity, written):
    found = comity("plan", written(), "--stability", "--json").json["stability"]
    assert (found["lowest"], found["highest"]) == (0.25, 4.0)
    assert found["stable"] == (not found["flips"])
    assert all(0.25 <= flip["factor"] <= 4.0 and flip["changes"] for flip in found["flips"])


def conditions(answer, person):
    (goal,) = [goal for goal in answer["unmet"] if goal["person"] == person]
    return {(each["kind"], each["name"]) for each in goal["conditions"]}, goal["together"]


WISH = {"name": "wish", "culture": "DEU", "settings": {"greeting_modality": "verbal"}}
TWO_WISHES = {
    **WISH,
    "settings": {"greeting_modality": "both", "greeting_gesture": "handshake"},
}


def test_what_stands_in_the_way_is_found_by_lifting_one_thing_at_a_time(comity, written):
    said = comity("plan", written({"people.yumi.profile": WISH}), "--json")
    assert said.code == 1
    assert conditions(said.json, "yumi") == ({("noise", "noise"), ("setting", "greeting_modality")}, False)
    assert {person for step in said.json["steps"] for person in step["people"]} == {"anna", "ben", "omar"}


RESTS = (
    "greeting gesture handshake: it was asked for and rests, because it requires that touch consent is "
    "given, which is not known or not so; state it once they say so, of a meeting in its scenario"
)


def test_a_greeting_that_was_asked_for_and_rests_is_said_with_the_reason_and_the_remedy(comity, written):
    """Nobody is touched without consent: another gesture instead, and not without a word."""
    wish = {"name": "omar", "settings": {"greeting_gesture": "handshake"}}
    hands_free = {"robot.carrying": None}
    name = written({"people.omar.profile": wish, **hands_free})
    assert RESTS in greeting(comity("plan", name, "--json").json, "omar")["why"]["text"]
    for command in (("plan", name), ("plan", name, "--why", "Greet_person(omar)")):
        assert RESTS in " ".join(comity(*command).out.split())
    stored = {**wish, "touch_consent": "given"}
    answer = comity("plan", written({"people.omar.profile": stored, **hands_free}), "--json").json
    assert RESTS in greeting(answer, "omar")["why"]["text"]
    here = {"people.omar.profile": wish, "people.omar.situation": HERE}
    answer = comity("plan", written({**here, **hands_free}), "--json")
    assert "handshake" in greeting(answer.json, "omar")["arguments"]
    assert "rests" not in answer.out


def test_in_a_group_it_is_said_whose_wish_rests(comity, written):
    wish = {"name": "ben", "settings": {"greeting_gesture": "handshake"}}
    answer = comity("plan", written({"people.ben.profile": wish}), "--json").json
    assert greeting(answer, "ben")["action"] == "Greet_company"
    assert f"ben: {RESTS}" in greeting(answer, "ben")["why"]["text"]


def test_where_one_thing_is_not_enough_the_smallest_set_is_named(comity, written):
    said = comity(
        "plan", written({"people.yumi.profile": TWO_WISHES, "people.yumi.situation": HERE}), "--json"
    )
    assert said.code == 1
    assert conditions(said.json, "yumi") == ({("noise", "noise"), ("hands", "robot")}, True)


def test_deadlines_that_cannot_be_kept_are_named(comity, written):
    """No plan at all: exit code 1, one JSON object, and the deadlines that stand in the way."""
    said = comity("plan", written({"goals.3.by_s": 12.0}), "--json")
    assert said.code == 1
    assert not said.json["solved"]
    assert conditions(said.json, "omar") == ({("deadline", "omar")}, False)
    text = comity("plan", written({"goals.3.by_s": 12.0}))
    assert text.code == 1
    assert "if omar could be greeted by " in " ".join(text.err.split())
    assert comity("run", "party.scenario.yaml").code == 1


def test_a_wall_that_shuts_somebody_off_is_named(comity):
    answer = comity("plan", "walled-in", "--json").json
    assert conditions(answer, "vera") == ({("side", "wall 1"), ("side", "wall 2")}, False)


def test_a_goal_that_is_true_already_is_a_success_with_an_empty_plan(comity, written):
    names = ["anna", "ben", "yumi", "omar"]
    name = written({"already": [{"greeted": person} for person in names]})
    said = comity("plan", name, "--json")
    assert said.code == 0
    assert said.json["steps"] == []
    assert said.json["already"] == names
    assert comity("run", name, "--json").json["outcome"] == "success"


def test_whom_the_scenario_lets_be_left_out_is_skipped_on_purpose(comity, written):
    """Omar's way costs more than leaving him out: that is a success, and the run says `skipped`."""
    name = written({"goals.3.skip": 0.5})
    plan = comity("plan", name, "--json").json
    assert plan["steps"][-1]["arguments"] == ["robot", "omar"]
    assert plan["steps"][-1]["cost_parts"] == {"skip": 50}
    answer = comity("run", name, "--json").json
    assert answer["outcome"] == "success"
    assert {v["person"] for v in answer["visits"] if v["outcome"] == "skipped"} == {"omar"}


def test_somebody_out_of_reach_may_be_left_out_too(comity, written):
    said = comity("plan", written({"people.yumi.profile": WISH, "goals.2.skip": 5}), "--json")
    assert said.code == 0
    assert said.json["unmet"] == []
    assert said.json["steps"][-1]["why"]["text"] == "no plan can serve them"


@pytest.mark.parametrize(
    ("changes", "complaint"),
    [
        ({"groups": {"window": ["anna", "anne"]}}, "Did you mean 'anna'?"),
        ({"groups": {"window": ["anna"]}}, "a group of at least two people"),
        ({"groups": {"a": ["anna", "ben"], "b": ["ben", "omar"]}}, "nobody in two groups"),
        ({"already": [{"greeted": "yum"}]}, "Did you mean 'yumi'?"),
        ({"goals.2.priority": -1}, "priority"),
        ({"goals.3.by_s": 0}, "by_s"),
        ({"place.noise_db": 900}, "noise_db"),
        ({"robot.carrying": ""}, "carrying"),
    ],
)
def test_a_bad_scenario_ends_with_its_line_and_a_remedy(comity, written, changes, complaint):
    said = comity("plan", written(changes))
    assert said.code == 2
    assert complaint in said.err
    assert "party.scenario.yaml:" in said.err


NICHE = """
schema_version: 1
name: niche
place:
  width_m: 6.0
  height_m: 5.0
  walls_m: [[[3.4, 5.0], [3.4, 3.55]], [[3.4, 2.65], [3.4, 0.0]], [[4.6, 5.0], [4.6, 0.0]]]
  furniture: [{name: bench, box_m: [3.45, 1.65, 1.1, 1.0]}]
robot: {at_m: [0.8, 0.8]}
people:
  nora: {at_m: [4.0, 3.95], facing_deg: -30}
  otto: {at_m: [1.2, 4.2], facing_deg: -45}
goals: [{greet: nora}, {greet: otto, by_s: 60}]
"""


@pytest.mark.parametrize("culture", CULTURES)
def test_a_niche_too_small_for_somebodys_taste_keeps_nobody_from_being_served(comity, written, culture):
    """The robot finds room at 0.65 m at most, where no rule would want it before some of these people."""
    answer = comity("run", written(text=NICHE), "--as", f"nora={culture}", "--json").json
    assert {visit["person"]: visit["outcome"] for visit in answer["visits"]} == {
        "nora": "greeted",
        "otto": "greeted",
    }


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("scenario", ["party", "reception"])
def test_who_is_served_is_the_same_whoever_has_which_culture(written, scenario, seed):
    """Cultural profiles drawn anew for everybody: the same people are served in every plan."""
    name = written() if scenario == "party" else scenario
    file = load_scenario(name)
    draw = random.Random(seed)
    profiles = {person: draw.choice(CULTURES) for person in file.scenario.people}
    plan = prepare(file, profiles=profiles).plan
    served = {person for step in plan.steps for person in step.people}
    assert served == set(file.scenario.visited())


LEARNT = {"conversational_distance": {"offset": 0.2, "spread": 0.1, "text": "1 visit: stepped back"}}


@pytest.mark.parametrize("changes", [{}, {"people.omar.profile": "own_wish", "people.yumi.learnt": LEARNT}])
def test_every_step_says_what_its_values_are_made_of(comity, written, changes):
    """What a rulebook decides has the contributions of the inference, which add up to the step's numbers."""
    name = written(changes)
    values, answer = prepare(load_scenario(name)).values, comity("plan", name, "--json").json
    for step in answer["steps"]:
        inferred = values[step["people"][0]].parameters
        assert step["contributions"].keys() == step["parameters"].keys() & inferred.keys()
        for parameter, made_of in step["contributions"].items():
            assert made_of == inferred[parameter].as_json()["contributions"]
            if not isinstance(made_of[0]["value"], str):
                total = sum(one["value"] for one in made_of)
                assert total == pytest.approx(step["parameters"][parameter])


def test_the_plan_names_the_origin_of_what_is_not_from_culture_alone(comity, written):
    text = comity("plan", written({"people.omar.profile": "own_wish", "people.yumi.learnt": LEARNT})).out
    plain = " ".join(text.split())
    assert "conversational distance 1.500 m (asked for)" in plain
    assert "off the front (situation)" in plain
    assert "m (culture + learnt)" in plain
    assert "(culture)" not in plain


def test_one_step_says_why_it_has_each_value(comity, written):
    """As `comity run` says it; what the person's own would be, too, where the plan does something else."""
    name = written({"people.yumi.learnt": LEARNT})
    values = prepare(load_scenario(name)).values["yumi"]
    reach = comity("plan", name, "--why", "Reach_user(yumi)", "--json").json["why"]["values"]
    assert [one["because"] for one in reach] == [
        because(values[one["parameter"]], values.inputs) for one in reach
    ]
    assert "learnt +0.200 m: 1 visit: stepped back" in comity("plan", name, "--why", "Reach_user(yumi)").out
    greet = comity("plan", name, "--why", "Greet_person(yumi)", "--json").json["why"]["values"]
    assert {one["parameter"]: (one["planned"], one["value"]) for one in greet} == {
        "greeting_modality": ("gestural", "both"),
        "greeting_gesture": ("nod", "bow"),
    }
    assert "bow by itself: " in comity("plan", name, "--why", "Greet_person(yumi)").out


def test_a_greeting_for_several_says_why_for_each(comity, written):
    name = written()
    (step,) = (one for one in comity("plan", name, "--json").json["steps"] if len(one["people"]) > 1)
    values = comity("plan", name, "--why", f"{step['action']}({step['people'][0]})", "--json").json["why"]
    assert {one["person"] for one in values["values"]} == {"anna", "ben"}
