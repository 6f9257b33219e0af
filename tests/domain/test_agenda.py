"""What is done at a visit beyond greeting: in its order, as cheaply as can be, with full hands in mind."""

from __future__ import annotations

import math
import random
from dataclasses import replace
from itertools import permutations

import pytest
from downward import cost_by_fast_downward, needs_fast_downward
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pareto import pareto

from comity_domain import (
    START,
    Circumstances,
    Offer,
    PlanningFailed,
    Say,
    Spot,
    TakeLeave,
    Visitee,
    VisitProgress,
    Wait,
    Weights,
    greetings,
    location,
    make_plan,
    offers,
    rebind,
    rest_of,
    sides,
)
from comity_domain.choices.options import options
from comity_domain.explanation.what_if import visits_of
from comity_domain.labelling.search import cheapest
from comity_domain.tours.tour import times_s
from tests.domain.conftest import price

TEA = Offer("tea", "kitchen")
GREETING_S, HANDOVER_S = 4.0, 3.0
AGENDA_ACTIONS = {Say: "Say", Offer: "Offer", Wait: "Wait", TakeLeave: "Take_leave"}


class Reference:
    """Every order, every side and both times of fetching, all pairs of cost and time: for very few people."""

    def __init__(self, request):
        self.request = request

    def least_cost(self):
        """None where nobody can visit all of them in time."""
        totals = []
        for order in permutations(self.request.visitees):
            if any(visitee.in_hand for visitee in order[1:]):
                continue  # what is in the hands is brought before all else
            ways, greeted = {START: {(0, 0.0)}}, 0
            for visitee in order:
                ways = self.after_visit(visitee, ways, greeted)
                greeted += not visitee.greeted
            totals += [cost for several in ways.values() for cost, _ in several]
        return min(totals, default=None)

    def after_visit(self, visitee, ways, greeted):
        """From where the robot may stand, with costs and times, to where it may stand after a visit."""
        brought, ends = offers(visitee.agenda), {}
        both = (False, True) if brought else (False,)
        for bringing in (True,) if visitee.in_hand else both:
            now = replace(visitee.now, robot_carries=brought[0].thing) if bringing else visitee.now
            greet = [self.dislike(g) for g in greetings(visitee.values, now)]
            leave = [self.dislike(g) for g in greetings(visitee.values, visitee.now)]
            if not greet and not visitee.greeted:
                continue
            here = ways
            if bringing and not visitee.in_hand:
                here = self.later(self.onward(here, location(brought[0].place)), HANDOVER_S)
            here = self.to_sides(here, visitee)
            if not visitee.greeted:
                waiting = greeted * round(100 * visitee.priority_m)
                here = self.in_time(self.later(here, GREETING_S, min(greet) + waiting), visitee)
            for offer in brought[bringing:]:
                here = self.later(self.onward(here, location(offer.place)), HANDOVER_S)
                here = self.to_sides(here, visitee)
            farewell = min(leave) if any(isinstance(t, TakeLeave) for t in visitee.agenda) else 0
            for spot, several in self.later(here, sum(map(lasts_s, visitee.agenda)), farewell).items():
                ends[spot] = ends.get(spot, set()) | several
        return {spot: pareto(several) for spot, several in ends.items()}

    def dislike(self, greeting):
        return price(greeting.desirability, self.request.weights.greeting_m)

    def later(self, ways, seconds, cost=0):
        return {spot: {(c + cost, s + seconds) for c, s in several} for spot, several in ways.items()}

    def in_time(self, ways, visitee):
        by_s = math.inf if visitee.by_s is None else visitee.by_s
        return {spot: {way for way in several if way[1] <= by_s} for spot, several in ways.items()}

    def to_sides(self, ways, visitee):
        found = {}
        for side in sides(visitee.values).values():
            spot = Spot(visitee.name, side.name)
            dislike = price(side.desirability, self.request.weights.side_m)
            found |= self.later(self.onward(ways, spot), 0.0, dislike)
        return found

    def onward(self, ways, spot):
        """The ways to a spot that no other one beats."""
        found = set()
        for here, several in ways.items():
            if (here, spot) in self.request.travel:
                way = (None if here == START else here.place, spot.place)
                cost = round(100 * self.request.travel[here, spot])
                seconds = self.request.durations_s.get(way, 0.0)
                found |= {(c + cost, s + seconds) for c, s in several}
        return {spot: pareto(found)} if found else {}


def cheapest_plan(request):
    """The plan, which costs as little as trying everything finds; None where neither finds any."""
    least = Reference(request).least_cost()
    if least is None:
        with pytest.raises(PlanningFailed):
            make_plan(request)
        return None
    plan = make_plan(request)
    assert (plan.cost, plan.optimal) == (least, True)
    return plan


def lasts_s(task):
    """By the page on costs; to take something up is not in it, as that may come before the greeting."""
    match task:
        case Say():
            return max(2.0, 0.1 * len(task.text))
        case Offer():
            return HANDOVER_S
        case Wait():
            return task.cap_s
    return 7.0


def begun(request, draw):
    """The same with visits that are under way: somebody was greeted, or the tea is in the hands."""
    bearer = draw.choice(request.visitees).name
    visitees = []
    for each in request.visitees:
        left = each.agenda[draw.randint(0, len(each.agenda)) :]
        in_hand = each.name == bearer and bool(offers(left)) and draw.random() < 0.5
        greeted = bool(left) and draw.random() < 0.5
        agenda = left if greeted or in_hand else each.agenda
        visitees.append(replace(each, agenda=agenda, greeted=greeted, in_hand=in_hand))
    return replace(request, visitees=tuple(visitees))


@pytest.mark.parametrize("seed", range(40))
def test_what_is_left_of_visits_is_planned_as_cheaply_as_can_be(agenda_request, seed):
    request = begun(plain(agenda_request(1 + seed % 3, seed)), random.Random(seed))
    plan = cheapest_plan(request)
    if plan is None:
        return
    assert rebind(plan, request) == plan
    for visitee in request.visitees:
        own = [step.action for step in plan.steps if step.person == visitee.name]
        assert ("Greet_person" in own) != visitee.greeted
        assert own.count("Fetch") == len(offers(visitee.agenda)) - visitee.in_hand
    bearer = next((visitee.name for visitee in request.visitees if visitee.in_hand), None)
    assert bearer in (None, plan.steps[0].person)


@pytest.mark.parametrize("seed", range(30))
def test_the_rest_of_a_cheapest_visit_is_the_cheapest_rest(agenda_request, seed):
    """Wherever the robot is in the middle of it, planning what is left from there gives what was planned."""
    request = plain(agenda_request(1, seed))
    try:
        plan = make_plan(request)
    except PlanningFailed:
        return
    (visitee,) = request.visitees
    for done in range(1, len(plan.steps)):
        past, left = plan.steps[:done], plan.steps[done:]
        tasks_left = sum(step.action in AGENDA_ACTIONS.values() for step in left)
        if not tasks_left:
            continue
        progress = VisitProgress(
            greeted=any(step.action == "Greet_person" for step in past),
            tasks_left=tasks_left,
            taken=holding(past),
        )
        rest = rest_of(plan, (), {visitee.name: progress})
        now = replace(
            visitee,
            agenda=visitee.agenda[len(visitee.agenda) - tasks_left :],
            greeted=progress.greeted,
            in_hand=progress.taken,
        )
        if not (now.greeted or now.in_hand):
            continue
        found = rebind(rest, replace(request, visitees=(now,), travel=travel_from(past, request)))
        assert found is not None
        stays = rest.steps[0].action == "Reach_user" and left[0].action not in (
            "Reach_user",
            "Return_to_user",
        )
        again = rest.steps[0].cost_parts["side"] if stays else 0  # the side where the robot stands counts
        assert found.cost == sum(step.cost for step in left) + again


def holding(steps) -> bool:
    """Whether something was fetched and not handed over."""
    return sum(step.action == "Fetch" for step in steps) > sum(step.action == "Offer" for step in steps)


def travel_from(past, request):
    """The ways, with the start where these steps lead to."""
    here = START
    for step in past:
        if step.action in ("Reach_user", "Return_to_user"):
            here = Spot(step.person, step.arguments[2])
        if step.action == "Fetch":
            here = location(step.arguments[3])
    onward = {(START, end): way for (start, end), way in request.travel.items() if start == here}
    between = {leg: way for leg, way in request.travel.items() if leg[0] != START}
    return {**between, **onward, **({(START, here): 0.0} if here.side != "there" else {})}


def test_visits_that_cannot_be_under_way_are_refused(infer):
    with pytest.raises(ValueError, match="nothing is left"):
        Visitee("ada", infer(), greeted=True)
    with pytest.raises(ValueError, match="nothing to be handed over"):
        Visitee("ada", infer(), agenda=(Say("a word"),), in_hand=True)


def plain(request):
    return replace(request, companies=())


@pytest.mark.parametrize("seed", range(12))
def test_the_plan_is_as_cheap_as_trying_everything(agenda_request, seed):
    request = plain(agenda_request(1 + seed % 3, seed))
    least = Reference(request).least_cost()
    found = cheapest(options(request))
    assert (found and found.cost) == least
    if least is None:
        with pytest.raises(PlanningFailed):
            make_plan(request)
        return
    plan = make_plan(request)
    assert plan.optimal
    assert plan.cost == least == sum(step.cost for step in plan.steps)
    assert rebind(plan, request) is not None


@pytest.mark.parametrize("seed", range(40))
def test_with_deadlines_the_plan_is_as_cheap_as_trying_everything(agenda_request, seed):
    """Taking something up on the way counts before the greeting, or not at all where it is in the hands."""
    request = plain(agenda_request(1 + seed % 3, seed, deadlines=True))
    draw = random.Random(seed)
    request = begun(request, draw) if seed % 4 == 3 else request
    request = replace(request, visitees=tuple(hurried(each, draw) for each in request.visitees))
    plan = cheapest_plan(request)
    if plan is None:
        return
    reckoned = times_s(visits_of(plan), options(request))
    assert all(
        greeted <= (options(request).people[visit.spot.place].by_s or math.inf)
        for visit, (greeted, _) in zip(visits_of(plan), reckoned, strict=True)
        if visit.way is not None
    )


@pytest.mark.parametrize("seed", range(12))
def test_a_greeting_is_over_when_all_that_comes_before_it_in_the_plan_was_done(agenda_request, seed):
    """Added up step by step, as the page on costs reckons deadlines."""
    request = plain(agenda_request(1 + seed % 3, seed, deadlines=True))
    lenient = tuple(replace(each, by_s=10_000.0) for each in request.visitees)
    request = replace(request, visitees=lenient)
    plan, now, greeted = make_plan(request), 0.0, []
    tasks = {each.name: iter(each.agenda) for each in request.visitees}
    for step in plan.steps:
        if step.action in ("Fetch", "Reach_user", "Return_to_user"):
            start, end = step.origin[0], step.arguments[3] if step.action == "Fetch" else step.person
            now += request.durations_s[None if start == START.place else start, end]
            now += HANDOVER_S * (step.action == "Fetch")
        elif step.action == "Greet_person":
            now += GREETING_S
            greeted.append(now)
        else:
            now += lasts_s(next(tasks[step.person]))
    assert [end for end, _ in times_s(visits_of(plan), options(request))] == pytest.approx(greeted)


def hurried(visitee, draw):
    """Somebody with a deadline about when they can be greeted first."""
    return visitee if visitee.greeted else replace(visitee, by_s=draw.choice((None, draw.uniform(8.0, 35.0))))


# the fixture is a function: nothing of it is left over between examples
@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(seed=st.integers(0, 10_000), count=st.integers(1, 3))
def test_everything_is_done_once_in_its_order_after_the_greeting(agenda_request, seed, count):
    """And hands are never full of two things, nor of something for somebody else."""
    request = agenda_request(count, seed, deadlines=True)  # planned by the label search, without a process
    request = replace(
        request, visitees=tuple(replace(v, priority_m=0.5, by_s=None) for v in request.visitees)
    )
    try:
        plan = make_plan(request)
    except PlanningFailed:
        return
    for visitee in request.visitees:
        own = [step for step in plan.steps if visitee.name in step.people]
        done = [step.action for step in own if step.action in AGENDA_ACTIONS.values()]
        assert done == [AGENDA_ACTIONS[type(task)] for task in visitee.agenda]
        actions = [step.action for step in own]
        greeted = next(i for i, action in enumerate(actions) if action.startswith("Greet"))
        assert not set(actions[:greeted]) - {"Fetch", "Reach_user"}
        assert actions.count("Fetch") == len(offers(visitee.agenda))
    holds = None
    for step in plan.steps:
        if step.action == "Fetch":
            assert holds is None
            holds = step.person
        if step.action in ("Reach_user", "Return_to_user", "Offer"):
            assert holds in (None, step.person)
        if step.action == "Offer":
            holds = None


def test_a_weight_flips_when_a_thing_is_fetched(infer, request_for, with_agendas):
    """A wave is worth another way to the kitchen where greetings weigh much, and not where little."""
    fond_of_waving = infer(
        modality="gestural",
        modalities={"gestural": 1.0, "verbal": 0.3},
        gesture="wave",
        gestures={"wave": 1.0, "nod": 0.3},
    )
    request = with_agendas(request_for({"ada": fond_of_waving}), {"ada": (TEA,)}, seed=1)
    orders = {}
    for factor in (0.25, 100.0):
        plan = make_plan(replace(request, weights=Weights(greeting_m=factor)))
        orders[factor] = [step.action for step in plan.steps]
    assert orders[0.25] == ["Fetch", "Reach_user", "Greet_person", "Offer"]
    assert orders[100.0] == ["Reach_user", "Greet_person", "Fetch", "Return_to_user", "Offer"]


def test_full_hands_rule_gestures_out_and_free_hands_open_them_for_the_farewell(
    infer, request_for, with_agendas
):
    fond_of_bowing = infer(
        modality="gestural", modalities={"gestural": 1.0}, gesture="bow", gestures={"bow": 1.0, "nod": 0.9}
    )
    request = with_agendas(request_for({"ada": fond_of_bowing}), {"ada": (TEA, TakeLeave())}, seed=1)
    steps = {step.action: step for step in make_plan(request).steps}
    assert steps["Greet_person"].arguments[2:] == ("gestural", "nod")
    assert steps["Take_leave"].arguments[2:] == ("gestural", "bow")
    out = {option.arguments[2:]: option.reason for option in steps["Greet_person"].why.ruled_out}
    assert out["gestural", "bow"] == "the robot carries tea"


def test_who_must_be_greeted_with_the_hands_is_greeted_before_the_thing_is_fetched(
    infer, request_for, with_agendas
):
    """An explicit wish is never traded, however much longer the way is."""
    asked = infer(gesture="bow", gestures={"bow": 1.0}, settings=["greeting_gesture"])
    request = with_agendas(request_for({"ada": asked}), {"ada": (TEA,)}, seed=1)
    plan = make_plan(request)
    assert [step.action for step in plan.steps][:2] == ["Reach_user", "Greet_person"]
    fetch = next(step for step in plan.steps if step.action == "Fetch")
    assert "no greeting is left" in fetch.why.ruled_out[0].reason


def test_a_deadline_counts_the_way_to_what_is_brought(infer, request_for, with_agendas):
    """Fetching first is cheaper and would be late: the robot greets first."""
    request = with_agendas(request_for({"ada": infer()}), {"ada": (TEA,)}, seed=1)
    durations = {(None, "ada"): 6.0, (None, "kitchen"): 5.0, ("kitchen", "ada"): 5.0, ("ada", "kitchen"): 5.0}
    near = {way: 3.0 if location("kitchen") in way else length for way, length in request.travel.items()}
    request = replace(request, travel=near)
    (ada,) = request.visitees
    late = replace(request, visitees=(replace(ada, by_s=20.0),), durations_s=durations)
    soon = replace(request, visitees=(replace(ada, by_s=11.0),), durations_s=durations)
    assert make_plan(late).steps[0].action == "Fetch"
    plan = make_plan(soon)
    assert plan.steps[0].action == "Reach_user"
    fetch = next(step for step in plan.steps if step.action == "Fetch")
    assert fetch.why.alternatives == ()
    (out,) = fetch.why.ruled_out
    assert out.reason == "ada would be greeted at 17.0 s, later than 11 s"
    assert times_s(visits_of(plan), options(soon))[0][0] <= 11.0


def test_of_several_things_only_the_first_can_be_fetched_before_the_greeting(
    infer, request_for, with_agendas
):
    """And the steps without a choice say that they have none; a coming back has sides to choose from."""
    agenda = (Say("a word"), TEA, Offer("cake", "kitchen"), Wait(2.0), TakeLeave())
    plan = make_plan(with_agendas(request_for({"ada": infer()}), {"ada": agenda}, seed=1))
    first, second = (step for step in plan.steps if step.action == "Fetch")
    assert "before the greeting" in first.why.text
    assert "after the one before, without a choice" in second.why.text
    for step in plan.steps:
        if step.action in ("Say", "Offer", "Wait"):
            assert "without a choice" in step.why.text
            assert step.why.alternatives == step.why.ruled_out == ()
    back = next(step for step in plan.steps if step.action == "Return_to_user")
    assert {other.arguments[2] for other in back.why.alternatives} == {"front", "left", "right"} - {
        back.arguments[2]
    }
    assert all(other.extra_cost >= 0 for other in back.why.alternatives)


@pytest.mark.parametrize("seed", range(6))
def test_exchanging_cultures_leaves_out_the_same_people(agenda_request, seed):
    """Also where what is offered makes the way to somebody longer; and nothing of theirs is done."""
    request = plain(agenda_request(4, seed))
    ways = {
        (None if a == START else a.place, b.place): length
        for (a, b), length in request.travel.items()
        if a.place != b.place
    }
    skipping = replace(
        request,
        ways_m=ways,
        visitees=tuple(replace(each, skip_m=3.0) for each in request.visitees),
    )
    left = []
    for shift in range(4):
        values = [each.values for each in skipping.visitees]
        exchanged = tuple(
            replace(each, values=values[(i + shift) % 4]) for i, each in enumerate(skipping.visitees)
        )
        plan = make_plan(replace(skipping, visitees=exchanged))
        out = {step.person for step in plan.steps if step.action == "Skip_visit"}
        assert not [step for step in plan.steps if step.person in out and step.action != "Skip_visit"]
        left.append(out)
    assert left.count(left[0]) == 4


def test_whoever_has_more_to_come_is_greeted_alone(infer, request_for, with_agendas, rich_request):
    request = next(r for seed in range(20) if (r := rich_request(4, seed, deadlines=False)).companies)
    member = request.companies[0].members[0]
    plan = make_plan(with_agendas(request, {member: (Say("a word"),)}, seed=1))
    assert next(s for s in plan.steps if member in s.people and "Greet" in s.action).action == "Greet_person"


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [
        (lambda: Visitee("ada", None, agenda=(TakeLeave(), Say("more"))), "nothing follows the farewell"),
        (lambda: Say("  "), "nothing to say"),
        (lambda: Wait(0.0), "more than no time"),
        (lambda: Wait(math.inf), "ends"),
    ],
)
def test_an_agenda_that_cannot_be_is_refused(spoil, complaint):
    with pytest.raises(ValueError, match=complaint):
        spoil()


def test_a_place_may_not_be_called_like_a_person(infer, request_for, with_agendas):
    with pytest.raises(ValueError, match="different names"):
        with_agendas(request_for({"kitchen": infer()}), {"kitchen": (TEA,)}, seed=1)


@needs_fast_downward
@pytest.mark.study
@pytest.mark.parametrize("seed", range(2))
def test_fast_downward_agrees_on_twelve_people_of_whom_three_are_brought_something(
    random_request, with_agendas, seed
):
    request = random_request(12, seed)
    agendas = {f"person {i}": (Say("here"), TEA, TakeLeave()) for i in (1, 4, 7)}
    request = with_agendas(request, agendas, seed)
    plan = make_plan(request)
    assert plan.optimal
    assert plan.cost == cost_by_fast_downward(request, time_limit_s=300.0)


def test_things_are_handed_over_where_the_robot_stopped(infer, line, request_for, with_agendas):
    """The step of an offer says the distance and bearing of the stop before, and no other value."""
    beside = infer(direction=60.0, curve=line(((0.0, 0.1), (60.0, 1.0), (90.0, 0.1))))
    plan = make_plan(with_agendas(request_for({"ada": beside}), {"ada": (TEA,)}, seed=1))
    steps = {step.action: step for step in plan.steps}
    where = ("conversational_distance", "approach_bearing")
    stop, offer = steps["Reach_user"], steps["Offer"]
    assert [offer.parameters[name] for name in where] == [stop.parameters[name] for name in where]
    assert offer.parameters["conversational_distance"] == pytest.approx(0.640213579)
    assert abs(offer.parameters["approach_bearing"]) > 22.5


def test_noise_leaves_no_words_with_what_is_handed_over(infer, request_for, with_agendas):
    request = with_agendas(request_for({"ada": infer()}), {"ada": (TEA,)}, seed=1)
    (ada,) = request.visitees
    noisy = replace(request, visitees=(replace(ada, now=Circumstances(noisy=True)),))
    offer = {step.action: step for step in make_plan(noisy).steps}["Offer"]
    assert offer.parameters["modality"] == "gestural"


@needs_fast_downward
@pytest.mark.parametrize("seed", range(12))
def test_another_planner_finds_the_cost_of_visits_under_way_on_their_pddl(agenda_request, seed):
    """Somebody was greeted, or the tea is in the hands: the exported problem begins there."""
    request = begun(plain(agenda_request(1 + seed % 3, seed)), random.Random(seed))
    try:
        cost = make_plan(request).cost
    except PlanningFailed:
        cost = None
    assert cost_by_fast_downward(request) == cost
