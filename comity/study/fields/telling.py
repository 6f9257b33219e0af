"""Reporting fields as Markdown to be completed, and as JSON output."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from comity.answers.study_with_people import ReportedFieldAnswer, StudyFieldsAnswer
from comity.study.fields.reported_field import ReportedField

TO_FILL = "**[to be filled in]**"
HEAD = f"""What Comity knows of this study stands here; what only the lab can know is marked {TO_FILL}.
Choice and names of the fields are Comity's own and stand for no standard. They follow the topics that the
working group IEEE P3108 lists; an appendix of this kind is proposed by Bagchi et al. 2023,
doi 10.1145/3568294.3580162."""


def fields_answer(study: str, fields: Sequence[ReportedField], file: str | None) -> StudyFieldsAnswer:
    """All fields of a study.

    Args:
        study: Its name.
        fields: Filled and blank fields.
        file: The written file; None without one.
    """
    return StudyFieldsAnswer(
        study=study,
        filled=sum(one.value is not None and one.applies for one in fields),
        blank=sum(one.value is None for one in fields),
        inapplicable=sum(not one.applies for one in fields),
        fields=tuple(
            ReportedFieldAnswer(
                section=one.section,
                field=one.name,
                value=one.value,
                asks=one.asks or None,
                applies=one.applies,
            )
            for one in fields
        ),
        file=file,
    )


def fields_markdown(study: str, fields: Sequence[ReportedField]) -> str:
    """The fields as Markdown, for the lab to complete."""
    return "\n".join([f"# Reporting {study}", "", HEAD, "", *_sections(fields)])


def _sections(fields: Sequence[ReportedField]) -> Iterator[str]:
    for section, members in groupby(fields, key=lambda one: one.section):
        yield from (f"## {section}", "")
        for one in members:
            value = f"{TO_FILL} {one.asks}" if one.value is None else one.value
            yield from (f"**{one.name}.** {value}", "")
