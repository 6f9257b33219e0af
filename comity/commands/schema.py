"""`comity schema`: what each file and each answer may hold, for editors and for other programs."""

from __future__ import annotations

from enum import StrEnum
from pkgutil import resolve_name
from typing import Annotated, Any

import typer

from comity.commands.options import print_json

DRAFT = "https://json-schema.org/draft/2020-12/schema"


class Kind(StrEnum):
    """What has a schema."""

    SCENARIO = "scenario"
    MAP = "map"
    PLACES = "places"
    PROFILE = "profile"
    RULEBOOK = "rulebook"
    WORDINGS = "wordings"
    BINDING = "binding"
    RUN = "run"
    PLAN = "plan"
    INFER = "infer"
    CONVERT = "convert"
    EXPLAIN = "explain"
    TRACE = "trace"
    METRICS = "metrics"
    FIT = "fit"
    PAPER = "paper"
    VISITS = "visits"
    LEARNT = "learnt"
    CONSENT = "consent"
    PROFILE_SHOW = "profile-show"
    PROFILE_ASK = "profile-ask"
    PROFILE_OBSERVE = "profile-observe"
    LIFE = "life"
    EVALUATE = "evaluate"
    LEARN = "learn"
    AUDIT = "audit"
    DRAW = "draw"
    TEST = "test"
    STUDY = "study"
    POPULATION = "population"
    STUDY_PLAN = "study-plan"
    STUDY_RUN = "study-run"
    STUDY_REPORT = "study-report"
    STUDY_COMPARE = "study-compare"
    STUDY_SHOW = "study-show"
    STUDY_POWER = "study-power"
    STUDY_SESSIONS = "study-sessions"
    QUESTIONNAIRE = "questionnaire"
    STUDY_SCORE = "study-score"
    COLLECTION = "collection"
    STUDY_COLLECT = "study-collect"
    STUDY_CLIPS = "study-clips"
    STUDY_FIELDS = "study-fields"


HOMES = {
    Kind.SCENARIO: "comity.scenario:Scenario",
    Kind.MAP: "comity_sim2d.maps.file:MapFile",
    Kind.PLACES: "comity_sim2d.maps.ros_map:PlacesFile",
    Kind.PROFILE: "comity.people.profile:Profile",
    Kind.RULEBOOK: "comity_fis.rulebook.models:RulebookModel",
    Kind.WORDINGS: "comity_executor.speech.wordings_file:WordingsFile",
    Kind.BINDING: "comity.specification.binding_file:BindingFile",
    Kind.RUN: "comity.answers.run:RunAnswer",
    Kind.PLAN: "comity.answers.plan:PlanAnswer",
    Kind.INFER: "comity.answers.inference:InferAnswer",
    Kind.CONVERT: "comity.answers.inference:ConvertAnswer",
    Kind.EXPLAIN: "comity.answers.explanation:ExplainAnswer",
    Kind.TRACE: "comity.answers.trace:TraceAnswer",
    Kind.METRICS: "comity.answers.figures:MetricsAnswer",
    Kind.FIT: "comity.answers.fit:FitAnswer",
    Kind.PAPER: "comity.answers.paper:PaperAnswer",
    Kind.VISITS: "comity.answers.visits:VisitsAnswer",
    Kind.DRAW: "comity.answers.figures:DrawAnswer",
    Kind.LEARNT: "comity.people.learnt_file:LearntFile",
    Kind.CONSENT: "comity.people.consents:ConsentFile",
    Kind.PROFILE_SHOW: "comity.answers.profile:ProfileAnswer",
    Kind.PROFILE_ASK: "comity.answers.profile:AskAnswer",
    Kind.PROFILE_OBSERVE: "comity.answers.profile:ObserveAnswer",
    Kind.LIFE: "comity.answers.profile:LifeAnswer",
    Kind.EVALUATE: "comity.answers.measuring:EvaluateAnswer",
    Kind.LEARN: "comity.answers.learning:LearnAnswer",
    Kind.AUDIT: "comity_fis.audit.audit:Audit",
    Kind.TEST: "comity.testing.reporting.answers:TestsAnswer",
    Kind.STUDY: "comity.study.study_file:StudyFile",
    Kind.POPULATION: "comity.study.population_file:PopulationFile",
    Kind.STUDY_PLAN: "comity.answers.study:StudyPlanAnswer",
    Kind.STUDY_RUN: "comity.answers.study:StudyRunAnswer",
    Kind.STUDY_REPORT: "comity.answers.study_report:StudyReportAnswer",
    Kind.STUDY_COMPARE: "comity.answers.study_report:StudyCompareAnswer",
    Kind.STUDY_SHOW: "comity.answers.study_report:StudyShowAnswer",
    Kind.STUDY_POWER: "comity.answers.study:StudyPowerAnswer",
    Kind.STUDY_SESSIONS: "comity.answers.study:StudySessionsAnswer",
    Kind.QUESTIONNAIRE: "comity.study.questionnaires.questionnaire_file:QuestionnaireFile",
    Kind.STUDY_SCORE: "comity.answers.study_with_people:StudyScoreAnswer",
    Kind.COLLECTION: "comity.study.collecting.collection_file:CollectionFile",
    Kind.STUDY_COLLECT: "comity.answers.study_with_people:StudyCollectAnswer",
    Kind.STUDY_CLIPS: "comity.answers.study_with_people:StudyClipsAnswer",
    Kind.STUDY_FIELDS: "comity.answers.study_with_people:StudyFieldsAnswer",
}
"""The module and the name of what has a schema: a record of an answer, or the model of a file."""


def schema(
    kind: Annotated[Kind, typer.Argument(help="A file that you write, or an answer that you get.")],
) -> None:
    """Print the JSON schema of a file or of an answer."""
    from pydantic import BaseModel

    from comity.answers.json_schema import schema_of

    home: Any = resolve_name(HOMES[kind])
    content = home.model_json_schema() if issubclass(home, BaseModel) else schema_of(home)
    print_json({"$schema": DRAFT, **content})
