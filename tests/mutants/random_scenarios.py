"""Scenarios drawn from a number: anything that a scenario may say, together by chance, and no expectation.

They are no part of the library and were not written with any mutant in view. What nobody can carry out, such
as somebody who stands in a wall, is refused by the software; such numbers are left out.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from random import Random
from typing import Any

import yaml

PROFILES = (
    "arab_man",
    "arab_woman",
    "british_elder",
    "four_levels",
    "german_host",
    "german_man",
    "german_woman",
    "indian_man",
    "japanese_woman",
    "one_life",
    "own_wish",
    "swedish_regular",
    "unknown",
)
CULTURES = ("DEU", "JPN", "GBR", "SWE", "IND", "Arab countries", "EGY", "unknown")
MAPS = {
    "apartment": ("front door", "sofa", "living room", "dining table", "cooker", "bedside", "desk"),
    "living-room": ("door", "in front of the sofa", "window", "dining table", "shelves"),
    "office": ("entrance", "desk 1", "desk 2", "desk 3", "desk 4", "printer", "office", "coffee"),
    "reception-hall": ("entrance", "reception", "waiting area", "bench", "leaflets", "cloakroom", "red room"),
    "ward": ("bed 1a", "bed 2b", "bed 3a", "corridor west", "nurses' station", "day room", "entrance"),
}
DOORS = {"apartment": "living room", "office": "office", "ward": "room 2", "reception-hall": "blue room"}
KEPT = {
    "apartment": "bookshelf",
    "living-room": "shelves",
    "office": "printer",
    "reception-hall": "leaflets",
    "ward": "piano",
}
"""Where something can be fetched."""
REACTIONS = ("curious", "scared", "threatening", "surprised", "impassive")
Entry = dict[str, Any]


def random_scenario(number: int) -> str:
    """The text of a scenario, which may be one that the software refuses."""
    dice = Random(f"episode {number}")
    place, spots, kept = _on_a_map(dice) if dice.random() < 0.35 else _room(dice)
    dice.shuffle(spots)
    at_start, *spots = spots
    names = [f"p{i}" for i in range(min(len(spots), dice.choice((1, 1, 2, 2, 2, 3, 3, 4, 5))))]
    rulebook = dice.choice(("bruno2017",) * 6 + ("evidence",) * 3 + ("illustrative-levels",))
    people = {name: _person(dice, spot, rulebook) for name, spot in zip(names, spots, strict=False)}
    company = _company(dice, people)
    visited = names if len(names) == 1 or company else names[: dice.randint(1, len(names))]
    done = [visited[-1]] if len(visited) > 2 and dice.random() < 0.15 else []
    scenario: Entry = {
        "schema_version": 1,
        "name": f"random {number}",
        "rulebook": rulebook,
        "at": "2019-06-01",
        "place": place,
        "robot": _robot(dice, at_start),
        "people": people,
        "goals": [goal for name in visited for goal in _goals(dice, name, len(visited), kept, done)],
        "limits": {"time_s": 60, "resumes": True, **_limits(dice)},
        **({"groups": {"company": company}} if company else {}),
        **({"keep_to": "left"} if dice.random() < 0.2 else {}),
        **({"passers_by": _passers_by(dice)} if dice.random() < 0.15 else {}),
        **({"already": [{"greeted": name} for name in done]} if done else {}),
    }
    if dice.random() < 0.5:
        free = [spot for spot in spots[len(names) :] if "at_m" in spot]
        scenario["changes"] = [_change(dice, names, free, rulebook) for _ in range(dice.randint(1, 3))]
    if dice.random() < 0.35:
        door = DOORS.get(place.get("map", ""))
        scenario["faults"] = [_fault(dice, names, visited, door) for _ in range(dice.randint(1, 2))]
    return yaml.safe_dump(scenario, sort_keys=False)


def _chance(dice: Random, **likely: tuple[float, Any]) -> Entry:
    """Those of the keys that are drawn, each with its chance and its value."""
    return {key: value for key, (chance, value) in likely.items() if dice.random() < chance}


def _near(dice: Random, number: float, by: float) -> float:
    return round(number + dice.uniform(-by, by), 2)


def _room(dice: Random) -> tuple[Entry, list[Entry], str]:
    """A room with furniture and perhaps a wall; places on a rough grid for whoever is there."""
    wide, high = round(dice.uniform(5.0, 12.0), 1), round(dice.uniform(4.5, 8.0), 1)
    cells = [(wide * (i + 0.5) / 4, high * (j + 0.5) / 3) for i in range(4) for j in range(3)]
    dice.shuffle(cells)
    boxes = [
        {"name": f"box {i}", "box_m": [round(x - 0.4, 2), round(y - 0.3, 2), 0.8, 0.6]}
        | ({"angle_deg": dice.randint(-90, 90)} if dice.random() < 0.3 else {})
        for i, (x, y) in enumerate(cells[: dice.randint(1, 3)])
    ]
    spots: list[Entry] = [
        {"at_m": [_near(dice, x, wide / 16), _near(dice, y, high / 14)]} for x, y in cells[len(boxes) :]
    ]
    place: Entry = {"width_m": wide, "height_m": high, "furniture": boxes}
    if dice.random() < 0.3:
        x = round(wide * dice.choice((0.25, 0.5, 0.75)), 2)
        place["walls_m"] = [[[x, 0.0], [x, round(high * dice.uniform(0.3, 0.8), 2)]]]
    return place | _noise(dice), spots, "box 0"


def _on_a_map(dice: Random) -> tuple[Entry, list[Entry], str]:
    name = dice.choice(tuple(MAPS))
    place: Entry = {"map": name}
    if name in DOORS and dice.random() < 0.2:
        place["doors"] = {DOORS[name]: "closed"}
    spots: list[Entry] = [{"at": each} for each in MAPS[name]]
    if dice.random() < 0.3:
        spots.append({"at": "random"})
    return place | _noise(dice), spots, KEPT[name]


def _noise(dice: Random) -> Entry:
    return _chance(dice, noise_db=(0.15, dice.randint(55, 95)), noisy=(0.03, True))


def _robot(dice: Random, spot: Entry) -> Entry:
    sensor = _chance(
        dice,
        noise_m=(0.3, round(dice.uniform(0.0, 0.04), 3)),
        delay_s=(0.3, dice.choice((0.1, 0.25))),
        range_m=(0.2, round(dice.uniform(2.0, 8.0), 1)),
        field_of_view_deg=(0.2, dice.choice((90, 180, 270))),
        hidden_by_walls=(0.2, True),
    )
    return {
        **spot,
        "facing_deg": dice.randint(-180, 180),
        "sensor": sensor,
        **_chance(
            dice,
            drive=(0.25, "differential"),
            carrying=(0.12, "a tray"),
            max_speed_m_s=(0.15, round(dice.uniform(0.2, 1.4), 2)),
            max_acceleration_m_s2=(0.15, round(dice.uniform(0.2, 1.5), 2)),
            max_jerk_m_s3=(0.15, round(dice.uniform(0.5, 10.0), 2)),
            emergency_deceleration_m_s2=(0.1, round(dice.uniform(0.5, 4.0), 2)),
        ),
    }


def _person(dice: Random, spot: Entry, rulebook: str) -> Entry:
    profile: Any = dice.choice(PROFILES) if dice.random() < 0.6 else _profile(dice)
    comfort = {"wants_m": [low := round(dice.uniform(0.5, 1.2), 2), round(low + dice.uniform(0.1, 0.6), 2)]}
    if dice.random() < 0.3:
        comfort["chance"] = 0.5
    there = spot.get("at_m", (3.0, 3.0))
    walks = {
        "route": [[_near(dice, there[0], 2.0), _near(dice, there[1], 2.0)], [*there]],
        **_chance(dice, loop=(0.7, True), pause_s=(0.5, dice.randint(1, 6)), stops=(0.4, True)),
        **_chance(dice, speed_m_s=(0.5, round(dice.uniform(0.4, 1.4), 2))),
    }
    sits = rulebook != "illustrative-levels" and dice.random() < 0.25
    return {
        "profile": profile,
        **spot,
        "facing_deg": dice.randint(-180, 180),
        **({"posture": "seated"} if sits else {}),
        **_chance(
            dice,
            situation=(0.35, _situation(dice, rulebook)),
            comfort=(0.3, comfort),
            walks=(0.15 if "at_m" in spot and not sits else 0.0, walks),
            reacts=(0.0 if sits else 0.15, dice.choice(REACTIONS)),
            learnt=(0.1, {"conversational_distance": _learnt(dice)}),
            carrying=(0.15, "a bag"),
            noise_db=(0.08, dice.randint(50, 95)),
        ),
    }


def _learnt(dice: Random) -> Entry:
    offset, spread = round(dice.uniform(-0.3, 0.4), 2), round(dice.uniform(0.05, 0.4), 2)
    return {"offset": offset, "spread": spread, "text": "learnt before"}


def _profile(dice: Random) -> Entry:
    """Somebody of whom anything may be known, and who may have asked for something."""
    mixed = {name: dice.randint(1, 5) for name in dice.sample(CULTURES[:-1], 2)}
    wishes = _wishes(dice)
    return {
        "name": "somebody",
        **_chance(
            dice,
            culture=(0.8, mixed if dice.random() < 0.4 else dice.choice(CULTURES)),
            gender=(0.7, dice.choice(("female", "male", "nonbinary"))),
            age=(0.5, dice.randint(8, 95)),
            touch_consent=(0.2, dice.choice(("given", "withheld"))),
            robot_experience=(0.2, dice.choice(("low", "high"))),
            education=(0.2, dice.randint(0, 8)),
            latitude=(0.2, dice.randint(-60, 65)),
            languages=(0.2, [dice.choice(("eng", "deu", "swe", "jpn"))]),
            settings=(0.4, wishes),
        ),
    }


def _wishes(dice: Random) -> Entry:
    found = _chance(
        dice,
        conversational_distance=(0.5, round(dice.uniform(0.45, 1.6), 2)),
        approach_speed=(0.3, round(dice.uniform(0.15, 0.5), 2)),
        approach_direction=(0.3, dice.choice((0, 45, 80))),
        greeting_modality=(0.3, dice.choice(("verbal", "gestural", "both"))),
        greeting_gesture=(0.3, dice.choice(("nod", "wave", "bow"))),
    )
    if found.get("greeting_modality") == "verbal":
        found.pop("greeting_gesture", None)
    return found or {"conversational_distance": 1.0}


def _situation(dice: Random, rulebook: str) -> Entry:
    known = {
        "bruno2017": {"robot_experience": ("low", "high"), "formality": ("informal", "formal")},
        "evidence": {
            "robot_experience": ("low", "high"),
            "familiarity": ("close", "acquaintance", "stranger"),
            "space": ("open", "narrow"),
            "occasion": ("informal", "formal"),
        },
        "illustrative-levels": {"age": (20, 70)},
    }[rulebook]
    names = dice.sample(sorted(known), dice.randint(1, len(known)))
    return {name: dice.choice(known[name]) for name in names}


def _company(dice: Random, people: Entry) -> list[str]:
    """Two or three who stand beside the first, face the same way, and are a group; nobody, more often."""
    members = list(people)[: dice.choice((2, 2, 3))]
    at = people[members[0]].get("at_m")
    if len(people) < 2 or at is None or dice.random() < 0.4:
        return []
    facing = people[members[0]]["facing_deg"]
    for i, name in enumerate(members):
        people[name]["at_m"] = [round(at[0] + 0.75 * i, 2), _near(dice, at[1], 0.2)]
        people[name]["facing_deg"] = facing + dice.randint(-30, 30)
        people[name].pop("walks", None)
    return members


def _goals(dice: Random, name: str, count: int, kept: str, done: Collection[str]) -> list[Entry]:
    """What is to be done with one person."""
    if name in done:
        return [{"greet": name}]
    greet: Entry = {"greet": name} | _chance(
        dice,
        priority=(0.3, round(dice.uniform(0.5, 12.0), 1)),
        by_s=(0.25, dice.randint(15, 25 + 20 * count)),
        skip=(0.2, round(dice.uniform(1.0, 14.0), 1)),
    )
    offers = [{"offer": thing, "to": name, "from": kept} for thing in ("tea", "a book")]
    tasks: list[Entry] = [{"say": "Something to tell.", "to": name}, *offers]
    tasks.append({"wait_s": dice.randint(1, 6), "with": name} | _chance(dice, until=(0.4, "moves")))
    chosen = dice.sample(tasks, dice.choice((0, 0, 0, 1, 1, 2, 3)))
    return [greet, *chosen, *([{"take_leave": name}] if dice.random() < 0.25 else [])]


def _limits(dice: Random) -> Entry:
    return _chance(
        dice,
        attend_s=(0.2, dice.choice((0, 2, 6))),
        replans=(0.15, dice.choice((0, 1, 2))),
        replan_pause_s=(0.15, dice.choice((0.5, 4.0))),
        patience_s=(0.2, dice.choice((0, 5, 20))),
        reach_attempts=(0.2, dice.choice((1, 3))),
        reach_s=(0.2, dice.choice((4, 8, 15))),
        act_s=(0.15, dice.choice((1.2, 3.0))),
        act_pause_s=(0.15, dice.choice((0.3, 2.0))),
        blocked_s=(0.15, dice.choice((0.5, 4.0))),
        passing_s=(0.15, dice.choice((1.0, 10.0))),
        detour_m=(0.2, dice.choice((0.5, 8.0))),
        unseen_s=(0.15, dice.choice((0.2, 3.0))),
    )


def _passers_by(dice: Random) -> Entry:
    return {"count": dice.randint(1, 4)} | _chance(dice, reacts=(0.5, dice.choice(("curious", "scared"))))


def _change(dice: Random, names: Sequence[str], free: Sequence[Entry], rulebook: str) -> Entry:
    at_s, person = round(dice.uniform(0.5, 20.0), 2), dice.choice(names)
    kind = dice.choice(("moves", "moves", "says", "situation", "emergency"))
    if kind == "emergency":
        return {"at_s": at_s, "emergency_stop_s": round(dice.uniform(0.5, 4.0), 2)}
    if kind == "moves" and free:
        to = {"moves_to_m": [*dice.choice(free)["at_m"]]}
        more = _chance(dice, facing_deg=(0.6, dice.randint(-180, 180)), speed_m_s=(0.3, 0.6))
        return {"at_s": at_s, "person": person, **to, **more}
    if kind == "situation":
        said = _situation(dice, rulebook)
        if rulebook != "illustrative-levels" and dice.random() < 0.5:
            said = {"posture": dice.choice(("seated", "standing"))}
        return {"at_s": at_s, "person": person, "situation": said}
    return {"at_s": at_s, "person": person, "says": _wishes(dice)}


def _fault(dice: Random, names: Sequence[str], visited: Sequence[str], door: str | None) -> Entry:
    kinds = ["wheel stuck", "speech fails", "sensor blind", "person walks off", "person in the way"]
    kind = dice.choice(
        [*kinds, "planner fails", "leaf raises", *(["door closes", "door opens"] if door else [])]
    )
    fault: Entry = {"at_s": round(dice.uniform(0.5, 20.0), 2), "fault": kind}
    if kind in kinds and kind != "person walks off":
        fault["for_s"] = round(dice.uniform(0.5, 8.0), 2)
    if kind.startswith("person"):
        fault["person"] = dice.choice(names)
    if kind.startswith("door"):
        fault |= {"door": door} | _chance(dice, for_s=(0.7, round(dice.uniform(1.0, 12.0), 1)))
    if kind == "leaf raises":
        leaf = dice.choice(("Navigate_to_user", "Dock_to_user", "Face_user", "docked?"))
        fault |= {"leaf": f"{leaf}({dice.choice(visited)})"} | _chance(dice, times=(0.4, 2))
    return fault
