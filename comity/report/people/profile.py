"""A person's profile, and the values inferred from it with their contributions."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from comity.answers.inference import ShownValueAnswer
from comity.answers.profile import ProfileAnswer
from comity.people.learnt_file import LearntFile, in_words
from comity.report.text import number, stated, table, unbroken, words
from comity.report.values.explanation_answer import graded_rule, graded_shift
from comity.report.values.inference import inputs_answer, speaks, value_fields
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import rests_on_facts

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from typing import Any, Literal

    from rich.console import RenderableType

    from comity.people.consents import ConsentFile
    from comity.people.profile import Declared
    from comity_fis import FiredRule, Inference, ParameterValue


@dataclass(frozen=True, slots=True)
class ShownProfile:
    """A person to be shown."""

    declared: Declared
    place: Literal["shipped", "kept", "file"]
    day: date | None
    inference: Inference
    learnt: Mapping[str, Any] | None
    note: str
    """Free text about the person; JSON output omits it for a stored person."""
    consents: ConsentFile | None
    """Their consents; None if none are recorded."""


def profile_answer(shown: ShownProfile) -> ProfileAnswer:
    """The answer of `comity profile show --json`."""
    file, inference = shown.declared.file, shown.inference
    return ProfileAnswer(
        name=shown.declared.profile.name,
        place=shown.place,
        file=str(file.path) if file else "",
        at=shown.day,
        declared=shown.declared.profile.model_dump(mode="json", exclude_defaults=True),
        learnt=shown.learnt,
        consents=tuple(one.model_dump(mode="json") for one in shown.consents.consents)
        if shown.consents
        else (),
        rulebook=inference.rulebook,
        inputs=inputs_answer(inference.inputs),
        notes=inference.notes,
        parameters={
            name: ShownValueAnswer(
                **value_fields(value),
                rules=tuple(map(graded_rule, value.fired)),
                shift=graded_shift(value.shift) if value.shift else None,
            )
            for name, value in inference.items()
        },
    )


def profile_text(shown: ShownProfile) -> Iterator[RenderableType]:
    """The person's own words, then each value with its contributions, rules, sources and grades."""
    profile, file = shown.declared.profile, shown.declared.file
    where = {"shipped": "ships with Comity", "kept": f"kept in {file.path if file else ''}"}
    yield unbroken(f"{profile.name} ({where.get(shown.place, 'a file')})")
    yield from ([f"  {shown.note.strip()}"] if shown.note else [])
    yield "\nDeclared" + (f", as of {shown.day}" if shown.day else "")
    yield table(list(_declared(shown)) or [("nothing", "which is everybody's right")])
    if profile.settings:
        yield "\nAsked for; it goes before everything but safety"
        yield table([(words(name), str(wish)) for name, wish in profile.settings.items()])
    if shown.place == "kept":
        yield "\nAgreed to"
        yield table(list(_consents(shown)) or [("nothing", "so that nothing more is kept")])
    if shown.learnt:
        yield "\nLearnt, by situation; `comity profile export` shows all of it"
        yield table(list(_learnt(shown.learnt)))
        simulated = sum(bool(one.get("simulated")) for one in shown.learnt.get(DISTANCE, ()))
        if simulated:
            yield (
                f"  {simulated} observations are simulated: by `comity visits --keep`, or in a scenario that "
                "states a `comfort`."
            )
    yield from (f"\nNote: {note}" for note in shown.inference.notes)
    yield f"\nWhat the robot goes by, as the rulebook {shown.inference.rulebook} has it"
    for value in shown.inference.parameters.values():
        yield from _value(value, shown.inference)


def _consents(shown: ShownProfile) -> Iterator[tuple[str, str]]:
    for one in shown.consents.consents if shown.consents else ():
        yield one.scope, one.in_words(date.today())


def _learnt(learnt: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """What a person showed and said, by situation."""
    everything = LearntFile.model_validate(learnt).conversational_distance
    situations = {str(dict(one.situation)): one.situation for one in everything}
    for situation in situations.values():
        here = [one for one in everything if one.situation == situation]
        where = ", ".join(str(fact) for fact in situation.values()) or "anywhere"
        for how in ("seen", "said"):
            if told := [one for one in here if one.how == how]:
                yield f"{where}, {how}", in_words(told)


def _declared(shown: ShownProfile) -> Iterator[tuple[str, str]]:
    profile = shown.declared.profile
    cultures = profile.cultures(shown.day)
    total = sum(one.weight for one in cultures)
    for one in cultures:
        share = f" ({one.weight / total:.0%})" if len(cultures) > 1 else ""
        yield "culture", f"{one.label(one.region)}{share}"
    if profile.region:
        yield "region", f"{profile.region}, for a culture without a score of its own"
    for name, fact in profile.facts(shown.day).items():
        unit = "years" if name == "age" else None
        yield words(name), ", ".join(fact) if isinstance(fact, tuple) else stated(fact, unit)


def _value(value: ParameterValue, inference: Inference) -> Iterator[RenderableType]:
    spread = f", people vary by ± {number(value.spread, value.unit)}" if value.spread else ""
    yield f"\n{words(value.name)}: {number(value.value, value.unit)}{spread}"
    yield table([(c.origin, number(c.value, value.unit), words(c.text)) for c in value.contributions])
    if value.parts:
        yield table(
            [(f"  {part.name} ({part.share:.0%})", number(part.value, value.unit)) for part in value.parts]
        )
    if value.note and not any(value.note in c.text for c in value.contributions):
        yield f"    {words(value.note)}"
    ordered = sorted(value.fired, key=lambda fired: not rests_on_facts(fired.rule, inference.inputs))
    shifting = value.shift.fired if value.shift else ()
    if grounds := [*(ordered if value.decided_by_rules else ()), *shifting]:
        yield table([_grounds(fired, inference) for fired in grounds])


def _grounds(fired: FiredRule, inference: Inference) -> tuple[str, str]:
    """A rule's text, and its grade of evidence."""
    rule = fired.rule
    keys = ", ".join(source.key for source in rule.sources)
    return (
        f"  {speaks(fired, inference.inputs, digits=2).split(',')[0]}",
        f"{words(rule.text)} [{fired.strength:.2f}; {rule.evidence}; {keys}]",
    )
