"""A reporting field, and the fields that only the lab can fill.

No text of IEEE P3108 was published as this was written. The fields follow the topics that its working group
lists in public (participants, study design, metrics and measures, data reporting), and what Cordero, Groechel
and Mataric, "What and How Are We Reporting in HRI?", arXiv 2201.09114, found missing (recruitment,
compensation, gender). An appendix of this kind is proposed by Bagchi et al., "Towards Improved Replicability
of Human Studies in Human-Robot Interaction", HRI 2023 Companion, of which only the abstract was at hand.
Choice, names and order of the fields are our own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

Section = Literal["Study", "Participants", "Robot", "Design", "Procedure", "Measures", "Data and analysis"]
SECTIONS: tuple[Section, ...] = get_args(Section)


@dataclass(frozen=True, slots=True)
class ReportedField:
    """One field."""

    section: Section
    name: str
    value: str | None
    """Known content, lines kept; None if the lab has to fill it in."""
    asks: str = ""
    """Instruction for the lab."""
    applies: bool = True
    """Whether the field applies to the study; if not, `value` says why."""


def blank(section: Section, name: str, asks: str) -> ReportedField:
    """A field that only the lab can fill."""
    return ReportedField(section, name, None, asks)


def inapplicable(section: Section, name: str, why: str) -> ReportedField:
    """A field that does not apply to a study of this kind."""
    return ReportedField(section, name, f"does not apply: {why}", applies=False)


BLANKS: tuple[ReportedField, ...] = (
    blank("Study", "Question and hypotheses", "what was asked, and what was expected before data were seen"),
    blank("Study", "Registration", "where and when the plan was registered, or that it was not"),
    blank("Study", "Ethics", "who approved it, under which number; risks, and what was done about them"),
    blank("Study", "Place", "country, laboratory or field, the room with its measures"),
    blank("Participants", "Reason for the number", "power, as `comity study power` gives it, or resources"),
    blank("Participants", "Recruitment", "where, how, from which population"),
    blank(
        "Participants",
        "Inclusion and exclusion",
        "criteria, decided before or after, and how many each left out",
    ),
    blank("Participants", "Compensation", "how much, in what form, or none"),
    blank(
        "Participants",
        "Withdrawals",
        "how many, and when: their answers are deleted, so that no count is left",
    ),
    blank("Participants", "Experience with robots", "how it was asked, and what it was"),
    blank("Robot", "Platform", "model, height and width, software of the maker, changes to it"),
    blank(
        "Robot",
        "Autonomy",
        "autonomous, shared or operated (Wizard of Oz): by whom, by which rules, seen or not",
    ),
    blank("Robot", "Behaviour", "what it said and did in each condition; scenario, rulebook and parameters"),
    blank("Design", "Blinding", "who knew the condition: participants, experimenter, analyst"),
    blank("Design", "Manipulation check", "whether participants noticed what was changed"),
    blank(
        "Procedure", "Instructions", "what participants were told, word for word; deception and debriefing"
    ),
    blank("Procedure", "Familiarisation", "what they did and saw before the first trial"),
    blank("Procedure", "Duration", "of a session, with breaks"),
    blank("Procedure", "Deviations", "from the plan; failures of the robot, and what was done then"),
    blank("Measures", "Wording", "language and translation of each questionnaire, items changed or left out"),
    blank("Measures", "Other measures", "recordings, logs, coding with the agreement of coders, interviews"),
    blank("Data and analysis", "Exclusions", "which data were left out, by which rule, decided when"),
    blank(
        "Data and analysis",
        "Analysis",
        "models and tests, repeated measures, corrections for several of them",
    ),
    blank("Data and analysis", "Results", "effect sizes with intervals, for each planned comparison"),
    blank("Data and analysis", "Availability", "where data, materials and code are, or why they are not"),
    blank("Data and analysis", "Limits", "to whom, and to which robots and places, the results apply"),
)
