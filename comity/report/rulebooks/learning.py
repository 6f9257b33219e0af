"""What a table teaches about a parameter: rules, prior, who predicts best, and what stands."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

from comity.answers.learning import (
    GroupPriorAnswer,
    LearnAnswer,
    LearntRuleAnswer,
    PriorAnswer,
)
from comity.report.difference import bare, difference, share, shown_unit
from comity.report.text import number, table, words, words_of
from comity.tables.contenders import ASK, CONSTANT, INDIVIDUAL, LINE
from comity.tables.leaving_out import LEAST_UNITS
from comity_fis.learning.pooling import DECLARED_PEOPLE, LEAST_PEOPLE
from comity_fis.learning.rule_table import LEAST_SUPPORT
from comity_fis.listing import listed
from comity_fis.rules.rule import Is
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.answers.learning import ErrorDifferenceAnswer
    from comity.tables.lesson import Kind, Lesson
    from comity_fis.learning.pooling import PooledPrior
    from comity_fis.learning.rule_table import Cell

SHOWN = 40
"""Rules or cultures; the JSON answer has all."""
MEANT = {
    CONSTANT: "the mean of the others",
    LINE: "a straight line over the inputs",
    ASK: "the person's own first answer",
    INDIVIDUAL: "the prior, brought to the person by that answer",
}


def learn_answer(lesson: Lesson, written: Kind | None, files: tuple[str, ...] = ()) -> LearnAnswer:
    """The answer of `comity learn --json`."""
    found, judged = lesson.examples, lesson.judgement
    return LearnAnswer(
        file=found.file,
        rulebook=lesson.rulebook.name,
        parameter=found.parameter.name,
        unit=found.parameter.unit,
        rows=len(found.rows),
        other_rows=found.others,
        people=found.people,
        studies=found.studies,
        unstated=found.unstated,
        unused=found.unused,
        inputs=lesson.inputs,
        lacking_inputs=lesson.lacking_inputs,
        rules=tuple(
            LearntRuleAnswer(
                rule=_rule(lesson, cell),
                conclusion=cell.conclusion,
                mean=cell.mean,
                support=cell.support,
                agreement=cell.agreement,
                weight=cell.weight,
                thin=cell.is_thin,
            )
            for cell in lesson.cells
        ),
        prior=_prior_answer(lesson, lesson.prior) if lesson.prior else None,
        constant=found.mean,
        left_out=judged.left_out,
        units=judged.units,
        errors=judged.errors,
        differences={kind: judged.differences[kind] for kind in lesson.proposals},
        in_the_way={kind: lesson.in_the_way(kind) for kind in lesson.proposals},
        stands=lesson.standing,
        written=written,
        files=files,
    )


def _prior_answer(lesson: Lesson, prior: PooledPrior) -> PriorAnswer:
    neutral = lesson.examples.parameter.neutral
    answers: dict[tuple[str, str], list[float]] = defaultdict(list)
    groups: dict[tuple[str, str], str | None] = {}
    for row in lesson.examples.rows:
        answers[row.person].append(row.value - row.before)
        groups[row.person] = row.group
    known = prior.within_person is not None
    return PriorAnswer(
        before=neutral,
        everybody=neutral + prior.everybody,
        groups={
            group: GroupPriorAnswer(
                people=one.people,
                mean=neutral + one.mean,
                value=neutral + one.offset,
                standard_error=one.standard_error,
                thin=one.is_thin,
            )
            for group, one in prior.groups.items()
        },
        between_groups=prior.between_groups,
        between_people=prior.between_people,
        seen_between_people=prior.seen_between_people,
        declared_spread=prior.declared_spread,
        within_person=prior.within_person,
        trust_in_one_answer=prior.trust(1) if known else None,
        individuals={
            "/".join(person): neutral + prior.known(groups[person], given)
            for person, given in answers.items()
            if known
        },
    )


def learn_text(lesson: Lesson) -> Iterator[RenderableType]:
    """The same, for a person to read."""
    found = lesson.examples
    yield (
        f"{words(found.parameter.name).capitalize()} from {found.file}: {counted(len(found.rows), 'row')} of "
        f"{counted(found.people, 'person', 'people')}, {counted(found.studies, 'study', 'studies')}"
    )
    read = words_of(lesson.inputs) or "nothing"
    yield f"In the terms of the rulebook {lesson.rulebook.name}; rules may read {read}."
    yield from _notes(lesson)
    yield from _rules(lesson)
    if lesson.prior is not None:
        yield from _prior(lesson, lesson.prior)
    yield from _judgement(lesson)
    yield from _verdict(lesson)


def _notes(lesson: Lesson) -> Iterator[str]:
    found = lesson.examples
    if not found.named:
        yield "No row names its participant: every row counts as a person, and no prior is made."
    if found.others:
        yield f"{counted(found.others, 'row')} on other parameters: not used."
    if found.unstated:
        points = "the nearest points" if found.parameter.measured == "surface" else "the centres"
        yield f"{counted(found.unstated, 'row')} without `measured`: taken as between {points} of the bodies."
    if found.unused:
        yield f"Headings that say nothing to this rulebook: {', '.join(found.unused)}"
    if lesson.lacking_inputs:
        yield f"Rows that teach no rule, since an input is unknown or no term: {lesson.lacking_inputs}."
    if found.studies > 1 and lesson.judgement.left_out != "study":
        yield (
            f"{found.studies} studies are taken together: what one measured otherwise looks like a "
            "difference between people. `--leave-out study` judges by studies."
        )


def _rules(lesson: Lesson) -> Iterator[RenderableType]:
    unit = lesson.examples.parameter.unit
    enough = [cell for cell in lesson.cells if not cell.is_thin]
    yield "\nRules that the rows propose"
    if enough:
        yield table(
            [
                (
                    str(place),
                    words(_rule(lesson, cell)),
                    number(cell.mean, unit),
                    f"{cell.support:.1f}",
                    f"{cell.agreement:.2f}",
                    f"{cell.weight:.2f}",
                )
                for place, cell in enumerate(enough[:SHOWN], 1)
            ],
            head=("", "rule", "mean", "support", "agreement", "weight"),
        )
        if len(enough) > SHOWN:
            yield f"  and {len(enough) - SHOWN} more; --json has all"
    else:
        yield "  None."
    if thin := len(lesson.cells) - len(enough):
        yield f"  No rule from {counted(thin, 'combination')} with a support below {LEAST_SUPPORT:g}."


def _prior(lesson: Lesson, prior: PooledPrior) -> Iterator[RenderableType]:
    parameter = lesson.examples.parameter
    unit, neutral = parameter.unit, parameter.neutral
    yield "\nPrior, each culture drawn towards everybody's value as far as its people are few"
    groups = list(prior.groups.items())
    yield table(
        [
            ("anybody else", str(prior.people), "", number(neutral + prior.everybody, unit)),
            *(
                (name, str(one.people), number(neutral + one.mean, unit), number(neutral + one.offset, unit))
                for name, one in groups[:SHOWN]
            ),
        ],
        head=("culture", "people", "mean", "prior"),
    )
    if len(groups) > SHOWN:
        yield f"  and {len(groups) - SHOWN} more; --json has all"
    of_people = f"{difference(prior.between_people, unit, sign=False)} between people of one culture"
    of_groups = f", {difference(prior.between_groups, unit, sign=False)} between cultures"
    of_groups = of_groups if len(groups) > 1 else ""
    yield f"  {number(neutral, unit)} stood before. Standard deviations: {of_people}{of_groups}."
    alone = "nothing"
    if prior.seen_between_people is not None:
        alone = difference(prior.seen_between_people, unit, sign=False)
    declared = difference(prior.declared_spread, unit, sign=False)
    yield (
        f"  Of people of one culture the rows alone say {alone}; {declared}, which the rulebook declares, "
        f"count as {DECLARED_PEOPLE} people more."
    )
    if thin := [name for name, one in groups if one.is_thin]:
        yield f"  Fewer than {LEAST_PEOPLE} people, so no rule of their own: {', '.join(thin[:SHOWN])}."
    if beyond := [name for name, one in groups if neutral + one.offset not in parameter.rules]:
        yield f"  Held to what rules can give, {parameter.rules} {unit}: {', '.join(beyond[:SHOWN])}."
    if prior.within_person is None:
        yield "  Nobody answered twice: what one answer is worth is not known."
    else:
        within = difference(prior.within_person, unit, sign=False)
        trust = share(prior.trust(1))
        yield f"  Answers of one person differ by {within}: one answer of theirs counts {trust}."


def _judgement(lesson: Lesson) -> Iterator[RenderableType]:
    judged, unit = lesson.judgement, lesson.examples.parameter.unit
    shown = f", in {shown_unit(unit)}" if shown_unit(unit) else ""
    yield f"\nMean absolute error on what was left out: each {judged.left_out} of {judged.units} once{shown}"
    yield table(
        [
            (
                name,
                bare(error.mean_absolute_error, unit, sign=False),
                str(error.units),
                *(_against(judged.differences[kind].get(name), unit) for kind in lesson.proposals),
            )
            for name, error in judged.errors.items()
        ],
        head=("what predicts", "error", "of", *(f"{kind} less it" for kind in lesson.proposals)),
    )
    meant = "; ".join(f"{name}: {text}" for name, text in MEANT.items() if name in judged.errors)
    yield (
        f"  {meant}. Differences on the same rows, with 95 % intervals (paired bootstrap); below 0 the "
        "proposal is nearer."
    )


def _against(one: ErrorDifferenceAnswer | None, unit: str) -> str:
    if one is None:
        return ""
    if one.low is None:
        return bare(one.difference, unit)
    return f"{bare(one.difference, unit)} ({bare(one.low, unit)} to {bare(one.high, unit)})"


def _verdict(lesson: Lesson) -> Iterator[str]:
    yield ""
    for kind in lesson.proposals:
        yield f"The {kind}: {_standing(lesson, kind)}."
    if not lesson.proposals:
        yield f"No combination of terms has a support of {LEAST_SUPPORT:g}."
    if lesson.standing is None:
        yield "Nothing stands."
        return
    asked = lesson.judgement.differences[lesson.standing].get(ASK)
    if asked is not None and asked.difference > 0:
        nearer = difference(asked.difference, lesson.examples.parameter.unit, sign=False)
        yield f"Asking the person once is nearer than the {lesson.standing} by {nearer}: ask where you can."


def _standing(lesson: Lesson, kind: Kind) -> str:
    """How a proposal stands to what is simpler: who is nearer, as near, and farther off."""
    judged, barred = lesson.judgement, lesson.in_the_way(kind)
    if barred and judged.units < LEAST_UNITS:
        return f"{judged.units} left out are too few to tell, {LEAST_UNITS} the least"
    against, unit = judged.differences[kind], lesson.examples.parameter.unit
    named = {CONSTANT: f"a constant of {number(lesson.examples.mean, unit)}", LINE: "a straight line"}
    nearer, level, beaten, perhaps = [], [], [], []
    for name in dict.fromkeys((*lesson.rivals(kind), *((LINE,) if LINE in against else ()))):
        one, called = against[name], named.get(name, f"the rulebook {name}")
        by = difference(abs(one.difference), unit, sign=False)
        if one.verdict == "worse":
            nearer.append(f"{called} is nearer by {by}")
        elif name in barred or (name == LINE and one.verdict != "better"):
            level.append(called)
        elif one.verdict == "better":
            beaten.append(called)
        else:
            perhaps.append(f"nearer than {called} by {by}, which may be chance")
    as_well = [f"{listed(level)} predict{'s' if len(level) == 1 else ''} as well"] if level else []
    beats = [f"nearer than {listed(beaten)}"] if beaten else []
    return "; ".join((*nearer, *as_well, *beats, *perhaps))


def _rule(lesson: Lesson, cell: Cell) -> str:
    return f"if {cell.antecedent} then {Is(lesson.examples.parameter.name, cell.conclusion)}"
