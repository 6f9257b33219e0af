"""`comity schema`: what each file and each answer may hold, for editors and for other programs."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from comity.commands.options import print_json

DRAFT = "https://json-schema.org/draft/2020-12/schema"


class Kind(StrEnum):
    """What has a schema."""

    SCENARIO = "scenario"
    MAP = "map"
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


def schema(
    kind: Annotated[Kind, typer.Argument(help="A file that you write, or an answer that you get.")],
) -> None:
    """Print the JSON schema of a file or of an answer."""
    from pydantic import BaseModel

    from comity import answers
    from comity.answers import measuring as measuring_answers
    from comity.answers import study as study_answers
    from comity.answers import study_report as study_report_answers
    from comity.answers.learning import LearnAnswer
    from comity.answers.study_with_people import (
        StudyClipsAnswer,
        StudyCollectAnswer,
        StudyFieldsAnswer,
        StudyScoreAnswer,
    )
    from comity.people.consents import ConsentFile
    from comity.people.learnt_file import LearntFile
    from comity.people.profile import Profile
    from comity.scenario import Scenario
    from comity.specification.binding_file import BindingFile
    from comity.study.collecting.collection_file import CollectionFile
    from comity.study.population_file import PopulationFile
    from comity.study.questionnaires.questionnaire_file import QuestionnaireFile
    from comity.study.study_file import StudyFile
    from comity.testing.reporting.answers import TestsAnswer
    from comity_executor.speech.wordings_file import WordingsFile
    from comity_fis import rulebook_schema
    from comity_sim2d.maps.file import MapFile

    if kind is Kind.RULEBOOK:
        print_json({"$schema": DRAFT, **rulebook_schema()})
        return
    models: dict[Kind, type[BaseModel]] = {
        Kind.SCENARIO: Scenario,
        Kind.MAP: MapFile,
        Kind.PROFILE: Profile,
        Kind.WORDINGS: WordingsFile,
        Kind.BINDING: BindingFile,
        Kind.RUN: answers.RunAnswer,
        Kind.PLAN: answers.PlanAnswer,
        Kind.INFER: answers.InferAnswer,
        Kind.CONVERT: answers.ConvertAnswer,
        Kind.EXPLAIN: answers.ExplainAnswer,
        Kind.TRACE: answers.TraceAnswer,
        Kind.METRICS: answers.MetricsAnswer,
        Kind.FIT: answers.FitAnswer,
        Kind.PAPER: answers.PaperAnswer,
        Kind.VISITS: answers.VisitsAnswer,
        Kind.DRAW: answers.DrawAnswer,
        Kind.LEARNT: LearntFile,
        Kind.CONSENT: ConsentFile,
        Kind.PROFILE_SHOW: answers.ProfileAnswer,
        Kind.PROFILE_ASK: answers.AskAnswer,
        Kind.PROFILE_OBSERVE: answers.ObserveAnswer,
        Kind.LIFE: answers.LifeAnswer,
        Kind.EVALUATE: measuring_answers.EvaluateAnswer,
        Kind.LEARN: LearnAnswer,
        Kind.AUDIT: measuring_answers.AuditAnswer,
        Kind.TEST: TestsAnswer,
        Kind.STUDY: StudyFile,
        Kind.POPULATION: PopulationFile,
        Kind.STUDY_PLAN: study_answers.StudyPlanAnswer,
        Kind.STUDY_RUN: study_answers.StudyRunAnswer,
        Kind.STUDY_REPORT: study_report_answers.StudyReportAnswer,
        Kind.STUDY_COMPARE: study_report_answers.StudyCompareAnswer,
        Kind.STUDY_SHOW: study_report_answers.StudyShowAnswer,
        Kind.STUDY_POWER: study_answers.StudyPowerAnswer,
        Kind.STUDY_SESSIONS: study_answers.StudySessionsAnswer,
        Kind.QUESTIONNAIRE: QuestionnaireFile,
        Kind.STUDY_SCORE: StudyScoreAnswer,
        Kind.COLLECTION: CollectionFile,
        Kind.STUDY_COLLECT: StudyCollectAnswer,
        Kind.STUDY_CLIPS: StudyClipsAnswer,
        Kind.STUDY_FIELDS: StudyFieldsAnswer,
    }
    print_json({"$schema": DRAFT, **models[kind].model_json_schema()})
