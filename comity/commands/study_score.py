"""`comity study score` and `questionnaire`: answers become scores, by a table that the lab fills in."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json

QuestionnaireName = Annotated[
    str,
    typer.Argument(metavar="QUESTIONNAIRE", help="Shipped (godspeed, rosas), or a file of your own."),
]
AnswersFile = Annotated[
    Path,
    typer.Argument(
        metavar="ANSWERS.csv", help="A row for each sheet with a column an item, or for each answer."
    ),
]
ScoresOut = Annotated[
    Path | None, typer.Option("--out", metavar="FILE.csv", help="Write the score of each sheet there.")
]


def score(
    questionnaire: QuestionnaireName, answers: AnswersFile, *, out: ScoresOut = None, as_json: AsJson = False
) -> None:
    """Score answers by subscale for each participant and condition, with Cronbach's alpha.

    Columns of the answers: participant, condition where there are several, and one for each item; or item
    and answer. Reversed items are turned round; there is no score over subscales.

    Example: comity study score godspeed answers.csv --out scores.csv
    """
    from comity.report.text import show
    from comity.study.questionnaires.answers_table import read_answers
    from comity.study.questionnaires.questionnaire_file import load_questionnaire
    from comity.study.questionnaires.scoring import SCORES_MARK, scored, scores_csv
    from comity.study.questionnaires.telling import score_answer, score_text
    from comity.system.own_files import refuse_foreign, write_whole

    if out is not None:
        refuse_foreign({out: SCORES_MARK})
    asked = load_questionnaire(questionnaire)
    table = read_answers(answers, asked)
    found = scored(asked, table)
    if out is not None:
        write_whole(out, scores_csv(asked, table, found).encode(), private=True)
    answer = score_answer(asked, table, found, (str(out),) if out else ())
    if as_json:
        print_json(answer)
    else:
        show(*score_text(answer))


def questionnaire(asked: QuestionnaireName) -> None:
    """Print a questionnaire's structure as YAML, to fill in the texts of your licence.

    Example: comity study questionnaire godspeed > our.questionnaire.yaml
    """
    from comity.study.questionnaires.questionnaire_file import load_questionnaire, questionnaire_path
    from comity.system.own_files import read_regular

    load_questionnaire(asked)
    print(read_regular(questionnaire_path(asked)).decode(), end="")
