"""`comity study sessions`: groups, orders and sheets for a study with people."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json

if TYPE_CHECKING:
    from collections.abc import Sequence

    from comity.answers.study import StudySessionsAnswer
    from comity.study.allocation import Session

Participants = Annotated[int, typer.Option("--participants", min=1, max=10_000, help="How many are to come.")]
Conditions = Annotated[
    str, typer.Option("--conditions", metavar="A,B,...", help="What each of them meets, in a balanced order.")
]
Groups = Annotated[
    str | None,
    typer.Option("--groups", metavar="X,Y,...", help="Between which they are divided; one group without it."),
]
Block = Annotated[
    int | None,
    typer.Option("--block", min=1, help="Participants in a block; twice the number of groups without it."),
]
SessionsOut = Annotated[Path, typer.Option("--out", metavar="DIR", help="Where allocation and sheets go.")]
StudyTitle = Annotated[str, typer.Option("--name", help="What the study is called on the sheets.")]
Trials = Annotated[int, typer.Option("--trials", min=1, max=50, help="Stop distances for each condition.")]
SessionsSeed = Annotated[int, typer.Option("--seed", min=0, help="Of all that is drawn.")]


def sessions(
    *,
    participants: Participants,
    conditions: Conditions,
    out: SessionsOut,
    groups: Groups = None,
    block: Block = None,
    name: StudyTitle = "Study",
    trials: Trials = 3,
    seed: SessionsSeed = 0,
    as_json: AsJson = False,
) -> None:
    """Divide participants between groups in blocks, balance their orders, and write a sheet for each.

    The same seed gives the same allocation, and more participants change nothing for those before them. An
    allocation that stands is never replaced by another one.

    Example: comity study sessions --participants 24 --conditions near,far --out sessions
    """
    from comity.report.text import show
    from comity.study.allocation import allocated

    names = _words(groups or "")
    found = allocated(participants, _words(conditions), names, block=block, seed=seed)
    answer = _answer(found, names, name=name, seed=seed, files=_written(found, out, name, trials))
    if as_json:
        print_json(answer)
        return
    sizes = ", ".join(f"{group} {count}" for group, count in answer.groups.items())
    show(
        f"{name}: {participants} sessions, {answer.orders} orders of {len(found[0].conditions)} conditions",
        *([f"  Groups: {sizes}"] if sizes else []),
        f"  {answer.files[0]} and {len(answer.files) - 1} sheets in {out}",
    )


def _words(text: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(",") if word.strip())


def _written(found: Sequence[Session], out: Path, name: str, trials: int) -> tuple[str, ...]:
    """Write the allocation and the sheets; their names in the folder.

    Raises:
        InputError: another allocation stands there that does not begin as this one goes on.
    """
    from comity.study.allocation import allocation_csv, sheet
    from comity.system.own_files import make_folder, read_regular, write_whole
    from comity_fis import InputError, Where

    text, path = allocation_csv(found), out / "allocation.csv"
    if path.exists() and not text.encode().startswith(read_regular(path)):
        raise InputError(
            expected="no allocation, or one that this one continues",
            got="another allocation",
            remedy="Name another folder: what was allocated stays.",
            where=Where(str(path)),
        )
    make_folder(out / "sheets", private=True)
    write_whole(path, text.encode(), private=True)
    files = ["allocation.csv"]
    for one in found:
        files.append(f"sheets/{one.participant}.txt")
        write_whole(out / files[-1], sheet(one, name, trials).encode(), private=True)
    return tuple(files)


def _answer(
    found: Sequence[Session], groups: Sequence[str], *, name: str, seed: int, files: tuple[str, ...]
) -> StudySessionsAnswer:
    from comity.answers.study import SessionAnswer, StudySessionsAnswer
    from comity.study.latin_square import balanced_orders

    counts = Counter(one.group for one in found)
    return StudySessionsAnswer(
        study=name,
        seed=seed,
        groups={group: counts[group] for group in groups},
        orders=len(balanced_orders(len(found[0].conditions))),
        sessions=tuple(
            SessionAnswer(
                participant=one.participant, group=one.group, block=one.block, conditions=one.conditions
            )
            for one in found
        ),
        files=files,
    )
