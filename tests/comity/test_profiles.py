"""What a person may declare: several cultures, dated facts, their own words, or nothing at all."""

from __future__ import annotations

from datetime import date, timedelta
from itertools import product

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

import comity as chain
from comity.parameters.values import infer_for
from comity.people.language import ALSO, iso639
from comity.people.profile import NOBODY, Declared, Profile, load_profile
from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario
from comity_executor.speech.phrasebook import SHIPPED
from comity_fis import (
    InputError,
    NumericParameter,
    countries,
    individualism_scores,
    load_rulebook,
    shipped_rulebooks,
)
from comity_fis.errors import WrongValueError
from comity_fis.rules.rule import literals

BOOKS = [load_rulebook(name) for name in shipped_rulebooks()]
BOOK = load_rulebook("bruno2017")
DAY = date(2020, 1, 1)

PLACES = [row.key for row in individualism_scores()] + [one.name for one in countries()]
"""Whether it has a score or not."""

FROM_HIGH_TO_LOW = [row.key for row in sorted(individualism_scores(), key=lambda row: row.value)[::-7]]
"""From the highest score to the lowest; enough to be nearest and fastest among."""

culture = st.sampled_from([*PLACES, "unknown"])
cultures = culture | st.dictionaries(culture, st.floats(0.1, 10), min_size=1, max_size=3)
day = st.dates(date(1990, 1, 1), date(2030, 1, 1))


def dated(values):
    """A value, or several with their days."""
    days = st.lists(day, min_size=1, max_size=3, unique=True).map(sorted)
    changing = days.flatmap(
        lambda chosen: st.tuples(*[values | st.just("unknown") for _ in chosen]).map(
            lambda told: [{"from": str(one), "value": value} for one, value in zip(chosen, told, strict=True)]
        )
    )
    return values | changing


facts = st.fixed_dictionaries(
    {"name": st.just("somebody")},
    optional={
        "culture": cultures,
        "gender": dated(st.sampled_from(["female", "male", "non-binary", "unknown"])),
        "birth_year": st.integers(1920, 1985),
        "education": dated(st.integers(0, 8)),
        "income": dated(st.sampled_from(["low", "high"]) | st.integers(0, 10**6)),
        "languages": st.lists(st.sampled_from(["ara", "swe", "fra", "eng"]), min_size=1, max_size=3),
        "latitude": st.floats(-90, 90),
        "touch_consent": dated(st.sampled_from(["given", "withheld"])),
        "familiarity": dated(st.sampled_from(["stranger", "acquaintance", "close"])),
        "posture": st.sampled_from(["standing", "seated"]),
        "robot_experience": dated(st.sampled_from(["low", "high"])),
        "formality": st.sampled_from(["informal", "formal"]),
    },
)


def of(**facts):
    return Declared(Profile.model_validate({"name": "somebody", **facts}), None)


@given(facts, day, st.sampled_from(BOOKS), st.data())
def test_nothing_that_is_kept_back_raises_an_error(told, when, book, data):
    """Whatever was told, and whichever part of it is taken back, there is an answer."""
    hidden = data.draw(st.sets(st.sampled_from(sorted(told))))
    kept = {key: value for key, value in told.items() if key == "name" or key not in hidden}
    answer = infer_for(of(**kept), book, at=when)
    for name, value in answer.parameters.items():
        parameter = book.parameters[name]
        if isinstance(parameter, NumericParameter):
            assert value.number in parameter.safe
            # what the rules alone give need not be in the range of what a person may ask for
            assert value.number in parameter.rules or value.number in parameter.ask


@given(facts, day)
def test_a_profile_written_out_reads_back_unchanged(told, when):
    profile = of(**told).profile
    for written in ({"exclude_defaults": True}, {"exclude_none": True}):
        again = Profile.model_validate(profile.model_dump(mode="json", **written))
        assert again == profile


@given(st.dictionaries(culture, st.floats(0.01, 100), min_size=1, max_size=4), st.sampled_from(BOOKS))
def test_a_person_of_several_cultures_is_met_between_them(weights, book):
    alone = [infer_for(of(culture=name, gender="female"), book) for name in weights]
    together = infer_for(of(culture=weights, gender="female"), book)
    for name, value in together.parameters.items():
        if isinstance(value.value, float):
            numbers = [one[name].number for one in alone]
            assert min(numbers) <= value.number <= max(numbers)


@given(st.sampled_from([book for book in BOOKS if "conversational_distance" in book.parameters]), st.data())
def test_a_wish_is_honoured_or_refused_never_bent(book, data):
    name, parameter = data.draw(
        st.sampled_from([(n, p) for n, p in book.parameters.items() if isinstance(p, NumericParameter)])
    )
    wish = data.draw(st.floats(parameter.ask.low - 1, parameter.ask.high + 1))
    person = of(culture={"Egypt": 1, "SWE": 2}, settings={name: wish})
    if wish in parameter.ask:
        value = infer_for(person, book)[name]
        assert value.number == parameter.safe.clamp(wish)
        origins = [step.origin for step in value.contributions]
        assert origins == (["setting"] if wish in parameter.safe else ["setting", "safety"])
        assert value.contributions[0].value == wish
    else:
        with pytest.raises(InputError, match=name):
            infer_for(person, book)


@pytest.mark.parametrize("book", BOOKS, ids=lambda book: book.name)
def test_saying_nothing_is_never_less_safe(book):
    """Nobody in particular is not met nearer, or faster, than everybody else in turn."""
    unknown = infer_for(load_profile("unknown"), book)
    everybody = [
        infer_for(of(culture=place, gender=gender, **more), book)
        for place, gender in product(FROM_HIGH_TO_LOW, ["female", "male"])
        for more in ({}, {"age": 25, "robot_experience": "high"}, {"age": 80, "robot_experience": "low"})
    ]
    for name, at_least in (("conversational_distance", True), ("approach_speed", False)):
        if name in book.parameters:
            value, safe = unknown[name].number, book.parameters[name].safe
            assert value in safe
            others = [one[name].number for one in everybody]
            assert value >= min(others) if at_least else value <= max(others)
    assert unknown == infer_for(NOBODY, book)


@pytest.mark.parametrize("name", ["culture", "gender", "age", "robot_experience", "posture"])
def test_unknown_is_an_answer_wherever_a_fact_is_asked_for(name):
    told = {"culture": "SWE", "gender": "female", "age": 40, "robot_experience": "high", "posture": "seated"}
    without = infer_for(of(**{key: value for key, value in told.items() if key != name}), BOOK)
    assert infer_for(of(**{**told, name: "unknown"}), BOOK) == without
    assert infer_for(of(**told), BOOK, situation={name: "unknown"}) == without
    assert infer_for(of(**told), BOOK, situation={name: None}) == without


@pytest.mark.parametrize("part", ["weight", "role", "region", "from", "until"])
def test_what_is_unknown_of_one_of_several_cultures_is_as_if_it_did_not_stand_there(part):
    several = [{"name": "JPN"}, {"name": "SWE", "weight": 2}]
    told = infer_for(of(culture=[{"name": "JPN", part: "unknown"}, several[1]]), BOOK)
    assert told == infer_for(of(culture=several), BOOK)


def test_a_country_without_a_score_is_an_honest_question():
    egypt = infer_for(of(culture="Egypt", gender="female"), BOOK)
    assert egypt["conversational_distance"] == infer_for(of(gender="female"), BOOK)["conversational_distance"]
    (note,) = egypt.notes
    assert "Egypt has no score" in note
    assert "Arab countries, East Africa, West Africa" in note


@pytest.mark.parametrize(
    "declared",
    [
        {"culture": "Egypt", "region": "Arab countries"},
        {"culture": [{"name": "Egypt", "region": "Arab countries"}]},
        {"culture": {"EGY": 3}, "region": "Arab countries"},
        {"culture": [{"name": "Nubia", "region": "Arab countries"}]},
    ],
)
def test_the_person_may_name_a_region(declared):
    named = infer_for(of(**declared, gender="female"), BOOK)
    assert named.notes == ()
    assert named.parameters == infer_for(of(culture="Arab countries", gender="female"), BOOK).parameters


def test_a_part_without_a_score_stays_a_question_for_its_share():
    mixed = infer_for(of(culture={"Egypt": 1, "SWE": 1}, gender="female"), BOOK)
    value = mixed["conversational_distance"]
    assert [part.name for part in value.parts] == ["Egypt", "Sweden"]
    undisclosed = infer_for(of(gender="female"), BOOK)["conversational_distance"].number
    assert value.parts[0].value == undisclosed
    assert mixed.notes


@pytest.mark.parametrize("gender", ["non-binary", "diverse", "agender", "two-spirit", "transfemale", "none"])
@pytest.mark.parametrize("book", BOOKS, ids=lambda book: book.name)
def test_a_gender_that_no_rule_speaks_of_is_disclosed_and_no_rule_about_gender_fires(gender, book):
    """It counts neither as not told nor as lying between two others."""
    told = infer_for(of(culture="DEU", gender=gender), book)
    if "gender" not in book.variables:
        assert told.parameters == infer_for(of(culture="DEU"), book).parameters
        return
    assert told.inputs["gender"] == gender
    assert any("gender" in note for note in told.notes)
    for value in told.parameters.values():
        assert not [
            fired
            for fired in value.fired
            if any(is_.name == "gender" for is_ in literals(fired.rule.antecedent))
        ]


@pytest.mark.parametrize(
    ("word", "gender"),
    [("woman", "female"), ("f", "female"), ("F", "female"), ("man", "male"), ("m", "male"), ("Man", "male")],
)
def test_woman_man_and_their_letters_are_understood_through_every_door(comity, word, gender):
    here = {"culture": "DEU", "gender": gender}
    right = infer_for(of(**here), BOOK)
    assert infer_for(of(culture="DEU", gender=word), BOOK) == right
    assert infer_for(of(culture="DEU"), BOOK, situation={"gender": word}) == right
    name = "conversational_distance"
    assert BOOK.infer({**here, "gender": word})[name] == BOOK.infer(here)[name]
    columns = {"culture": ["DEU"], "gender": [word]}
    assert BOOK.infer_many(columns)[name][0] == pytest.approx(right[name].number, abs=1e-12)
    said = comity("infer", "--set", "culture=DEU", "--set", f"gender={word}", "--json").json
    assert said["inputs"]["gender"] == gender
    assert said["notes"] == []


@pytest.mark.parametrize("gender", ["Female", "FEMALE", "Male", "nonbinary", "Diverse"])
def test_a_profile_and_the_command_line_take_the_same_words_in_any_case(comity, gender):
    """Known words are known in capitals, too; own words stay as they are, wherever they are said."""
    assert comity("profile", "set", "someone", "culture=DEU", f"gender={gender}").code == 0
    kept = comity("infer", "someone", "--rulebook", "bruno2017", "--json").json
    told = comity("infer", "--set", "individualism=67", "--set", f"gender={gender}", "--json").json
    known = gender.lower() in ("female", "male")
    assert kept["inputs"]["gender"] == told["inputs"]["gender"] == (gender.lower() if known else gender)
    assert kept["notes"] == told["notes"]
    assert bool(told["notes"]) == (not known)
    name = "conversational_distance"
    assert kept["parameters"][name]["value"] == told["parameters"][name]["value"]


def test_a_word_of_the_command_line_goes_before_the_profiles_where_no_rule_knows_it(comity):
    said = comity("infer", "german_woman", "--set", "gender=nonbinary", "--json").json
    assert said["inputs"]["gender"] == "nonbinary"


personal = st.fixed_dictionaries(
    {},
    optional={
        "hearing": st.sampled_from(["impaired", "hearing aid"]),
        "sight": st.sampled_from(["impaired", "glasses"]),
        "mobility": st.sampled_from(["wheelchair", "walking frame"]),
        "form_of_address": st.sampled_from(
            ["Dr Okafor", {"name": "Sato", "title": "san", "order": "name title"}]
        ),
        "other": st.dictionaries(
            st.sampled_from(["hearing", "mobility", "cognition", "pets"]), st.just("some"), max_size=2
        ),
    },
).filter(lambda told: not told.keys() & told.get("other", {}).keys())


@given(facts, personal, day, st.sampled_from(BOOKS))
def test_a_profile_works_with_every_rulebook_and_says_which_facts_nothing_reads(told, more, when, book):
    without, with_ = infer_for(of(**told), book, at=when), infer_for(of(**told, **more), book, at=when)
    assert with_.parameters == without.parameters
    unread = {*more.keys() - {"other", "form_of_address"}, *more.get("other", {})}
    noted = " ".join(note for note in with_.notes if "that is on reads" in note)
    assert [name for name in unread if name not in noted] == []


@pytest.mark.parametrize("name", ["hearing", "sight", "mobility", "form_of_address"])
def test_a_personal_fact_is_accepted_on_the_command_line_and_in_python(comity, name):
    said = comity("infer", "--set", f"{name}=some", "--json")
    assert said.code == 0
    is_noted = name != "form_of_address"  # the robot's words read it, whatever the rules do
    assert any(name in note for note in said.json["notes"]) == is_noted
    assert any(name in note for note in chain.infer(**{name: "some"}).notes) == is_noted


def test_an_unread_fact_that_looks_like_a_typo_is_asked_about():
    (note,) = infer_for(of(other={"postur": "seated"}), BOOK).notes
    assert "Did you mean 'posture'?" in note
    (note,) = infer_for(of(other={"mobility": "wheelchair"}), BOOK).notes
    assert "Did you mean" not in note


def test_capitals_make_no_difference_to_a_situation_or_a_consent(comity):
    one, other = (
        comity(
            "infer", "german_woman", "--set", f"posture={word}", "--set", f"touch_consent={consent}", "--json"
        )
        for word, consent in (("seated", "given"), ("Seated", "GIVEN"))
    )
    assert one.out == other.out
    assert of(touch_consent="Given").profile.touch_consent == "given"


def test_an_age_that_nobody_reaches_is_refused_on_the_command_line_too(comity):
    assert comity("infer", "--set", "age=119").code == 0
    assert comity("infer", "--set", "age=1000").code == 2


def test_a_language_that_no_rule_knows_counts_as_not_told():
    book = load_rulebook_text(BOOK_WITH_LANGUAGE.replace("NAME", "speaks"))
    assert infer_for(of(), book, situation={"language": "SWE"}).inputs["language"] == "swe"
    fra = infer_for(of(languages=["ara"]), book, situation={"language": "fra"})
    assert fra.inputs["language"] is None
    assert "fra" in fra.notes[0]


def test_the_first_language_that_a_rulebook_knows_is_the_one():
    text = BOOK_WITH_LANGUAGE.replace("NAME", "speaks")
    book = load_rulebook_text(text)
    assert infer_for(of(languages=["fra", "swe", "ara"]), book).inputs["language"] == "swe"
    nobody = infer_for(of(languages=["fra"]), book)
    assert nobody.inputs["language"] is None
    assert "fra" in nobody.notes[0]


@pytest.mark.parametrize("words", ["swe", "SWE", "sv", "sv-FI", "Swedish", "swedish"])
def test_a_language_may_be_called_by_its_codes_or_its_english_name(words):
    book = load_rulebook_text(BOOK_WITH_LANGUAGE.replace("NAME", "speaks"))
    assert infer_for(of(languages=["fra", words]), book).inputs["language"] == "swe"
    assert infer_for(of(), book, situation={"language": words}).inputs["language"] == "swe"


@pytest.mark.parametrize(
    "words", ["Sámi", "Língua Gestual Portuguesa", "zh-Hant-TW", "العربية", "हिन्दी", "N'Ko"]
)
def test_no_language_is_refused_for_being_unknown(words):
    """It counts as not told, with a note, and is kept as it was said."""
    declared = of(languages=[words])
    assert declared.profile.languages == (words,)
    book = load_rulebook_text(BOOK_WITH_LANGUAGE.replace("NAME", "speaks"))
    answer = infer_for(declared, book)
    assert answer.inputs["language"] is None
    assert words in answer.notes[0]


def test_the_languages_that_have_other_names_are_those_that_the_robot_speaks():
    assert set(ALSO) == set(SHIPPED)
    for code in SHIPPED:
        assert iso639(SHIPPED[code].tag) == code


BOOK_WITH_LANGUAGE = """\
schema_version: 1
name: NAME
description: one variable
sources: {design: {citation: "made up", verified: nothing}}
variables:
  language: {kind: situation, level: nominal, categories: [ara, swe], reason: made up}
parameters:
  gesture:
    kind: action
    level: nominal
    categories: [wave, nod]
    neutral: nod
    reasons: {categories: made up, neutral: made up}
rules:
  - {rule: if language is swe then gesture is wave, sources: [design], evidence: design}
"""


def load_rulebook_text(text):
    from pathlib import Path

    from comity_fis.validation.yaml_file import parse_yaml

    return load_rulebook(parse_yaml(text, Path("book.yaml"), "book.yaml"))


@given(dated(st.integers(0, 8)), day)
def test_a_dated_fact_holds_from_its_day_until_the_next(education, when):
    told = of(education=education).profile.facts(when).get("education")
    if isinstance(education, int):
        assert told == education
        return
    begun = [one["value"] for one in education if date.fromisoformat(one["from"]) <= when]
    assert told == (None if not begun or begun[-1] == "unknown" else begun[-1])


@given(st.dates(date(1920, 1, 1), date(2020, 12, 31)), st.integers(0, 36_000))
def test_the_age_follows_from_the_birth(born, days):
    when = born + timedelta(days=days)
    exact = of(birth_date=str(born)).profile.facts(when)["age"]
    assert abs(exact - days / 365.2425) < 1.01
    rough = of(birth_year=born.year).profile.facts(when)["age"]
    assert exact == rough if isinstance(rough, float) else exact in rough


def test_a_culture_counts_from_its_day_until_another():
    person = of(
        culture=[
            {"name": "Egypt", "role": "grew up", "region": "Arab countries"},
            {"name": "SWE", "role": "lives in", "from": "2004-08-15", "until": 2010},
        ]
    )
    shares = [
        [part.name for part in infer_for(person, BOOK, at=date(year, 6, 1))["approach_speed"].parts]
        for year in (2003, 2005, 2012)
    ]
    assert shares == [[], ["Egypt, grew up, as Arab countries", "Sweden, lives in"], []]


def test_facts_that_depend_on_the_day_want_one():
    with pytest.raises(InputError, match="--at"):
        infer_for(of(birth_year=1950), BOOK)


def test_a_day_before_the_birth_is_refused():
    with pytest.raises(WrongValueError, match="in the future of that day"):
        infer_for(of(birth_year=1950), BOOK, at=date(1940, 1, 1))


@pytest.mark.parametrize("name", ["two-visits", "reception"])
def test_who_is_served_does_not_depend_on_whose_culture_is_whose(name):
    """Culture decides how, never who: however profiles are dealt out, the same people are served."""
    file = load_scenario(name)
    people = list(file.scenario.people)
    profiles = ["arab_woman", "german_man", "japanese_woman", "one_life", "own_wish"][: len(people)]
    served = [
        {visitee.name for visitee in prepared.asked.request.visitees}
        for dealt in (profiles, profiles[::-1])
        for prepared in [prepare(file, profiles=dict(zip(people, dealt, strict=True)), at=DAY)]
    ]
    assert served == [set(file.scenario.visited())] * 2


def test_two_people_with_one_profile_get_the_same_treatment():
    prepared = prepare(
        load_scenario("two-visits"), profiles=dict.fromkeys(("host", "guest"), "one_life"), at=DAY
    )
    assert prepared.values["host"] == prepared.values["guest"]


def recorded(scenario, out, **how):
    """The account of a run without pictures."""
    return record(prepare(load_scenario(scenario), **how), out=out, views=()).answer


def test_a_run_records_its_day_and_the_trace_does_not(here):
    first = recorded("johanna", here / "a", profiles={"johanna": "one_life"}, at=date(2012, 5, 1))
    assert first.at == date(2012, 5, 1)
    assert "at: '2012-05-01'" in (here / "a" / "scenario.yaml").read_text()
    assert "2012" not in (here / "a" / "trace.jsonl").read_text()
    again = recorded("a/scenario.yaml", here / "b")
    assert (again.at, again.trace_sha256) == (first.at, first.trace_sha256)
    other = recorded("a/scenario.yaml", here / "c", at=date(2003, 1, 1))
    assert other.at == date(2003, 1, 1)
    assert other.trace_sha256 == first.trace_sha256  # the run holds the facts of its day alone
    life = recorded("johanna", here / "d", profiles={"johanna": "one_life"}, at=date(2003, 1, 1))
    assert life.trace_sha256 != first.trace_sha256


def test_no_date_is_recorded_where_nothing_depends_on_it(here):
    assert recorded("tea-visit", here / "a").at is None
    assert not [line for line in (here / "a" / "scenario.yaml").read_text().splitlines() if line[:3] == "at:"]


def test_today_is_recorded_where_something_does(here):
    assert recorded("johanna", here / "a", profiles={"johanna": "one_life"}).at is not None


def test_the_front_door_takes_a_day():
    young, old = (chain.infer("one_life", at=day) for day in ("2009-01-01", date(2022, 1, 1)))
    assert young["approach_speed"].number > old["approach_speed"].number
    with pytest.raises(InputError, match="YYYY-MM-DD"):
        chain.infer("one_life", at="next week")


def test_contributions_are_told_in_every_report(comity, here):
    (here / "x.yaml").write_text("name: x\nculture: {Egypt: 1, SWE: 2}\nregion: Arab countries\n")
    for words in (
        ["infer", "x.yaml"],
        ["explain", "conversational_distance", "x.yaml"],
        ["run", "--as", "johanna=x.yaml"],
        ["profile", "show", "x.yaml"],
    ):
        said = comity(*words)
        assert said.code == 0, said.err
        assert "Egypt, as Arab countries" in said.out
        assert "Sweden" in said.out
    runs = comity("run", "--as", "johanna=x.yaml", "--json").json["values"]["johanna"]["parameters"]
    shown = comity("profile", "show", "x.yaml", "--json").json["parameters"]
    told = comity("infer", "x.yaml", "--json").json["parameters"]
    explained = comity("explain", "conversational_distance", "x.yaml", "--json").json
    for value in (
        runs["conversational_distance"],
        shown["conversational_distance"],
        told["conversational_distance"],
        explained,
    ):
        (start,) = value["contributions"]
        assert start["origin"] == "culture"
        assert start["value"] == value["value"]
        assert [part["share"] for part in value["parts"]] == pytest.approx([1 / 3, 2 / 3])
    assert [part["name"] for part in explained["by_culture"]] == ["Egypt, as Arab countries", "Sweden"]


def test_a_mixed_explanation_keeps_to_its_schema_and_draws_one_culture_only(comity, here):
    (here / "x.yaml").write_text("name: x\nculture: {JPN: 1, SWE: 2}\n")
    words = ["explain", "greeting_gesture", "x.yaml"]
    answer = comity(*words, "--json").json
    jsonschema.validate(answer, comity("schema", "explain").json)
    assert sum(part["share"] for part in answer["by_culture"]) == pytest.approx(1)
    said = comity(*words, "--picture", "why.png")
    assert said.code == 2
    assert "Japan and Sweden" in said.err
    one = comity(*words, "--set", "culture=SWE", "--picture", "why.png")
    assert one.code == 0, one.err
    assert (here / "why.png").exists()


def test_a_wish_of_somebody_of_several_cultures_is_explained_at_once(comity, here):
    (here / "x.yaml").write_text(
        "name: x\nculture: {JPN: 1, SWE: 2}\nsettings: {conversational_distance: 0.9}\n"
    )
    answer = comity("explain", "conversational_distance", "x.yaml", "--json").json
    assert (answer["value"], answer["by_culture"], answer["parts"]) == (0.9, [], [])
    assert answer["without_setting"]


def test_the_trace_of_somebody_of_several_cultures_ends_in_all_of_them(comity, here):
    (here / "x.yaml").write_text("name: x\nculture: {JPN: 1, SWE: 2}\ngender: female\n")
    comity("run", "--as", "johanna=x.yaml", "--out", "run")
    told = {
        cause["text"]
        for event in comity("trace", "run", "--json").json["events"]
        for cause in event["because"]
        if cause["kind"] == "variable"
    }
    assert "individualism 46 (Japan, 33%) and 71 (Sweden, 67%)" in told


def test_exchanging_two_profiles_changes_how_people_are_met_and_nobody_is_left_out():
    met = [
        {visit.person: visit for visit in chain.run("two-visits", profiles=profiles).visits}
        for profiles in (
            {"host": "arab_woman", "guest": "german_man"},
            {"host": "german_man", "guest": "arab_woman"},
        )
    ]
    assert [{name: visit.outcome for name, visit in one.items()} for one in met] == [
        {"host": "greeted", "guest": "greeted"}
    ] * 2
    here, there = ({name: visit.docked_at.distance_m for name, visit in one.items()} for one in met)
    assert here["host"] == pytest.approx(there["guest"], abs=0.01)
    assert here["guest"] == pytest.approx(there["host"], abs=0.01)


def test_a_profile_that_was_written_anew_is_read_anew(here):
    """What a file says is remembered by its text, for the matrix of many tests."""
    ages = (30, 31, 30)
    for age in ages:
        (here / "ann.profile.yaml").write_text(f"schema_version: 1\nname: Ann\nage: {age}\n")
        assert load_profile("./ann.profile.yaml").profile.age == age
