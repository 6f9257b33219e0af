"""The audit: what a rulebook rests on, whom it covers, and what it does to people who differ in one thing."""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import combinations
from math import isclose

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_fis import individualism_scores, load_rulebook, shipped_rulebooks
from comity_fis.audit import (
    StudyGroup,
    attributes,
    audit,
    conflicts,
    count_evidence,
    coverage,
    decided_by,
    held_to,
    shipped_findings,
    sweep,
)
from comity_fis.audit.coverage import said
from comity_fis.audit.order import OrderCounts
from comity_fis.audit.sweep import combinations as ways

BOOKS = {name: load_rulebook(name) for name in shipped_rulebooks()}
AUDITS = {name: audit(book) for name, book in BOOKS.items()}
EVERY = pytest.mark.parametrize("name", BOOKS)


@EVERY
def test_the_counts_add_up(name):
    book, found = BOOKS[name], AUDITS[name]
    evidence, findings = found.evidence, found.findings
    numbers = [
        n for group in (evidence.grades, evidence.off) for of_grade in group.values() for n in of_grade
    ]
    assert sorted(numbers) == [rule.number for rule in book.rules]
    assert evidence.with_counter_evidence <= sum(map(len, evidence.grades.values()))
    assert sum(one.pairs for one in findings.by_attribute.values()) == findings.counts.pairs
    held = [row for row in findings.rows if row.verdict is not None]
    assert sum(one.pairs for one in findings.findings_by_attribute.values()) == len(held)
    pairs = {(f.parameter, frozenset((f.larger, f.smaller))) for f in shipped_findings()}
    assert findings.counts.pairs + findings.untested == len(pairs)
    assert findings.within.pairs <= findings.counts.pairs
    assert all((row.verdict is None) == bool(row.reason) for row in findings.rows)


@EVERY
def test_an_audit_is_the_same_every_time(name):
    assert audit(BOOKS[name]) == AUDITS[name]


@EVERY
def test_what_is_not_listed_changes_nothing(name):
    """Nobody's value moves with an attribute that the audit calls unread."""
    book, found = BOOKS[name], AUDITS[name]
    known = attributes(book)
    for parameter, unread in found.coverage.unread.items():
        for attribute in unread:
            for place in known[attribute].levels[:5]:
                told = said(book, known[attribute], place)
                assert book.infer(told)[parameter].value == book.infer({})[parameter].value


@EVERY
def test_ranges_and_pairs_tell_the_same_story(name):
    """The widest range over nationality or gender is the largest difference between two of its values."""
    found = AUDITS[name]
    effects = {(one.parameter, one.attribute): one for one in found.effects}
    for pair in found.pairs:
        effect = effects[pair.parameter, pair.attribute]
        assert (pair.example is None) == (effect.changed == 0)
        assert 0 <= pair.differing <= 1
        if pair.largest is not None:
            assert isclose(pair.largest, effect.largest, abs_tol=1e-12)
            assert pair.median <= pair.largest
            assert isclose(abs(pair.example.first_value - pair.example.second_value), pair.largest)


@EVERY
def test_an_example_is_what_inference_gives_two_such_people(name):
    book, known = BOOKS[name], attributes(BOOKS[name])
    for pair in AUDITS[name].pairs:
        if pair.example is None:
            continue
        same: dict[str, object] = {}
        for fact, label in pair.example.otherwise.items():
            if label != "not disclosed":
                same |= said(book, known[fact], known[fact].labels.index(label))
        for label, value in (
            (pair.example.first, pair.example.first_value),
            (pair.example.second, pair.example.second_value),
        ):
            attribute = known[pair.attribute]
            told = said(book, attribute, attribute.labels.index(label))
            assert book.infer({**same, **told})[pair.parameter].value == pytest.approx(value)


@given(st.data())
@settings(max_examples=60)
def test_a_sweep_is_what_inference_finds_one_by_one(data):
    book = BOOKS[data.draw(st.sampled_from(list(BOOKS)))]
    known = attributes(book)
    parameter = data.draw(
        st.sampled_from([name for name in book.parameters if decided_by(book, name, known)])
    )
    decides = list(decided_by(book, parameter, known).values())
    attribute = data.draw(st.sampled_from(decides))
    others = [other for other in decides if other is not attribute]
    swept = sweep(book, parameter, attribute, others)
    row = data.draw(st.integers(0, len(swept.values) - 1))
    place = data.draw(st.integers(0, len(attribute.labels) - 1))
    facts = said(book, attribute, place)
    for other, level in zip(others, swept.contexts[row].tolist(), strict=True):
        facts |= {} if level < 0 else said(book, other, level)
    assert swept.values[row, place] == book.infer(facts)[parameter].value or (
        swept.values[row, place] == pytest.approx(book.infer(facts)[parameter].value)
    )


def test_one_fact_about_culture_is_a_name_and_a_score(bruno2017):
    culture = attributes(bruno2017)["culture"]
    assert set(culture.columns) == {"individualism", "culture"}
    assert culture.labels == tuple(row.key for row in individualism_scores())
    place = culture.labels.index("DEU")
    assert said(bruno2017, culture, place) == {"individualism": 67.0, "culture": "DEU"}


def test_every_row_of_the_scores_is_covered_or_none(case2):
    """The paper's rules reach all 78; a rulebook without culture reaches nobody by culture."""
    covered = {name: (one.coverage.cultures, one.coverage.scored) for name, one in AUDITS.items()}
    assert covered["bruno2017-case2"] == (78, 78)
    assert covered["illustrative-levels"] == (0, 78)
    assert AUDITS["bruno2017"].coverage.named == ("DEU", "GBR", "IND", "JPN")


def test_the_audit_names_whom_the_neutral_value_meets():
    alone = {(one.parameter, one.attribute): one for one in AUDITS["bruno2017"].coverage.alone}
    assert alone["greeting_modality", "touch_consent"].neutral == ("given", "withheld")
    assert alone["approach_speed", "robot_experience"].neutral == ("high",)
    by_culture = alone["conversational_distance", "culture"]
    assert by_culture.values - len(by_culture.neutral) == 78


def test_the_papers_two_cases_do_not_contradict_themselves():
    """LC1 and LC2 pass into each other, and so do the terms that they conclude."""
    assert AUDITS["bruno2017-case1"].conflicts == AUDITS["bruno2017-case2"].conflicts == ()


def test_a_handshake_and_a_wave_are_a_contradiction():
    found = {(one.first, one.second): one for one in AUDITS["bruno2017"].conflicts}
    conflict = found[16, 20]
    assert (conflict.first_term, conflict.second_term) == ("handshake", "wave")
    assert conflict.example["culture"] == "DEU"
    assert conflict.strength > 0.99


def test_a_rule_against_another_is_found(write):
    """The same condition, opposite ends of one scale."""
    book = load_rulebook(
        write(("if warmth is cold then distance is away", "if warmth is warm then distance is away"))
    )
    found = [one for one in conflicts(book, attributes(book)) if one.parameter == "distance"]
    assert [(one.first, one.second, one.strength) for one in found] == [(1, 2, 1.0), (1, 3, 1.0), (2, 3, 1.0)]
    assert all(one.people <= one.tried for one in found)


def test_evidence_is_counted_by_grade_and_parameter(small):
    found = count_evidence(small)
    assert found.grades == {"weak": (1, 2, 3, 4, 5, 6, 7)}
    assert found.parameters == {"distance": {"weak": 3}, "gesture": {"weak": 2}, "volume": {"weak": 2}}
    assert (found.off, found.with_counter_evidence) == ({}, 0)


def test_what_is_read_through_another_parameter_counts(small):
    """Volume reads the distance, which reads warmth and mood."""
    known = attributes(small)
    assert set(decided_by(small, "volume", known)) == {"warmth", "mood"}
    assert set(decided_by(small, "gesture", known)) == {"warmth", "mood", "touch_consent"}
    assert coverage(small, known).cultures == 0


def test_too_many_combinations_become_a_sample_with_a_fixed_seed(bruno2017, monkeypatch):
    monkeypatch.setattr(sys.modules["comity_fis.audit.sweep"], "MOST", 300)
    known = attributes(bruno2017)
    decides = decided_by(bruno2017, "approach_speed", known)
    others = [other for name, other in decides.items() if name != "robot_experience"]
    first, again = (sweep(bruno2017, "approach_speed", known["robot_experience"], others) for _ in range(2))
    assert not first.complete
    assert np.array_equal(first.values, again.values)
    assert first.values.size <= 300
    assert set(first.context(0).values()) == {"not disclosed"}


@given(st.lists(st.integers(1, 4), max_size=4))
def test_all_combinations_are_there_once(sizes):
    rows, complete = ways([np.arange(size) for size in sizes], 10_000)
    assert complete
    assert len({tuple(row) for row in rows.tolist()}) == len(rows) == np.prod(sizes, dtype=int)


def test_the_findings_are_those_that_the_docs_count():
    """15 pairs of countries with an order, 9 of them that of the scores; and one pair found alike."""
    scores = {row.key: row.value for row in individualism_scores()}
    pairs = [
        (one, scores[one.larger.value] - scores[one.smaller.value])
        for one in shipped_findings()
        if not one.reservation and {one.larger.value, one.smaller.value} <= scores.keys()
    ]
    ordered = [difference for one, difference in pairs if one.relation == ">"]
    assert len({(one.larger, one.smaller) for one, _ in pairs}) == len(pairs) == 16
    assert (sum(d > 0 for d in ordered), sum(d < 0 for d in ordered)) == (9, 6)


def test_a_finding_is_held_against_two_people_of_whom_only_that_is_known(case2):
    found = held_to(case2, shipped_findings(), attributes(case2))
    rows = {(row.finding.key, str(row.finding)): row for row in found.rows}
    german = rows["eresha2013", "DEU > Arab countries"]
    assert german.verdict == "agreeing"
    assert german.larger == case2.infer({"individualism": 67})["conversational_distance"].number
    assert rows["sicorello2019", "JPN > DEU"].verdict == "contradicting"
    assert rows["hogholesen2008", "DNK > ITA"].verdict == "equal"
    assert rows["joosse2014", "ARG = USA"].verdict == "contradicting"
    assert rows["remland1991", "male = female"].verdict == "contradicting"
    assert "knows no culture GRL" in rows["hogholesen2008", "GRL > ITA"].reason


def test_what_several_studies_find_of_a_pair_counts_once(case2):
    """Three studies have men farther apart than women, and one has both alike: one pair, men farther."""
    found = held_to(case2, shipped_findings(), attributes(case2))
    rows = [row for row in found.rows if row.finding.larger == StudyGroup("gender", "male")]
    assert [row.finding.relation for row in rows] == [">", ">", ">", "="]
    assert found.by_attribute["gender"] == OrderCounts(1, 0, 0)
    assert found.findings_by_attribute["gender"] == OrderCounts(3, 3, 0)
    assert found.disputed == ((StudyGroup("gender", "male"), StudyGroup("gender", "female")),)


@given(st.lists(st.sampled_from([">", "<", "="]), min_size=1, max_size=6))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40)
def test_a_pair_counts_once_however_often_and_in_whatever_order_it_is_reported(case2, reports):
    """As most studies have it, and as different where they are equally many."""
    (base,) = [one for one in shipped_findings() if one.key == "hecht2019"]
    turned = replace(base, larger=base.smaller, smaller=base.larger)
    as_found = {">": base, "<": turned, "=": replace(base, relation="=")}
    found = held_to(case2, [as_found[report] for report in reports], attributes(case2))
    assert (found.counts.pairs, found.within.pairs, found.untested) == (1, 1, 0)
    assert bool(found.disputed) == (len(set(reports)) > 1)
    if reports.count(">") > len(reports) / 2:
        assert found.counts.agreeing == 1
    if reports.count("=") <= len(reports) / 2 and reports.count("<") == 0:
        assert found.counts.agreeing == 1


@given(st.randoms(use_true_random=False))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=20)
def test_the_order_of_the_findings_does_not_matter(case2, source):
    findings, known = list(shipped_findings()), attributes(case2)
    before = held_to(case2, findings, known)
    source.shuffle(findings)
    after = held_to(case2, findings, known)
    assert (after.counts, after.within, after.untested) == (before.counts, before.within, before.untested)
    assert set(map(frozenset, after.disputed)) == set(map(frozenset, before.disputed))


def test_a_finding_turned_round_is_judged_the_other_way(case2):
    known = attributes(case2)
    for one in shipped_findings():
        turned = replace(one, larger=one.smaller, smaller=one.larger)
        verdicts = [held_to(case2, [each], known).rows[0].verdict for each in (one, turned)]
        if verdicts[0] is None or one.relation == "=" or verdicts[0] == "equal":
            assert verdicts[0] == verdicts[1]
        else:
            assert set(verdicts) == {"agreeing", "contradicting"}


def test_gender_makes_as_much_difference_as_the_two_rules_of_a_country(case2):
    (found,) = [one for one in AUDITS["bruno2017-case2"].pairs if one.attribute == "gender"]
    assert found.pairs == 79  # 78 rows of scores, and somebody who names none
    by_hand = [
        abs(a - b)
        for score in [None, *(row.value for row in individualism_scores())]
        for a, b in combinations(
            [
                case2.infer({"individualism": score, "gender": gender})["conversational_distance"].number
                for gender in ("female", "male")
            ],
            2,
        )
    ]
    assert found.largest == pytest.approx(max(by_hand))
    assert found.median == pytest.approx(np.median(by_hand))


def test_every_variable_belongs_to_one_attribute():
    for book in BOOKS.values():
        names = [name for attribute in attributes(book).values() for name in attribute.columns]
        assert sorted(names) == sorted(book.variables)
        for attribute in attributes(book).values():
            assert attribute.facts(-1) == {}
