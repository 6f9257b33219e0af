"""Execution of a study: runs the episodes missing in its journal, then writes its tables.

Only the command writes. The journal has every ended episode, synced to disk, so a study continues after a
stop, a kill, a full disk or a lost cluster.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, suppress
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from comity.answers.study import StudyRunAnswer
from comity.study.episode_rows import ERROR, StudyRow
from comity.study.estimate import factors_of
from comity.study.folder import ACCOUNT, DICTIONARY, JOURNAL, PARQUET, RESULTS, WRITTEN, study_folder
from comity.study.journal import opened_journal, read_journal
from comity.study.parquet import has_pyarrow, write_parquet
from comity.study.statement import STATEMENT
from comity.study.table import StudyTable, study_table
from comity.study.tasks import task_of
from comity.system.own_files import write_whole, written_whole
from comity_fis import InputError
from comity_fis.record import as_text

if TYPE_CHECKING:
    from comity.study.carrying import EpisodeRunner
    from comity.study.study_plan import StudyCell, StudyPlan

Watch = Callable[[int], None]
"""Called with the number of episodes that have just ended."""


def run_study(
    plan: StudyPlan,
    out: Path,
    connect: Callable[[], EpisodeRunner],
    start: Callable[[int, int], Watch],
) -> StudyRunAnswer:
    """Run the missing episodes, and write the tables.

    Args:
        plan: The study.
        out: Folder of the study.
        connect: Returns the runner; called once the folder is known to be usable.
        start: Called with the number of missing and of all episodes; returns the callback for ended ones.

    Raises:
        InputError: if the folder or the cluster cannot be used.
        OSError: if the disk is full.
    """
    with study_folder(out, plan.written.name):
        carrier = connect()
        missing, account = _begun(plan, out, carrier)
        watch, lost = start(account.episodes - account.done, account.episodes), 0
        try:
            tasks = (task_of(plan, cell, carrier.installed) for cell, *_ in missing.values())
            with opened_journal(out / JOURNAL) as journal, closing(carrier.carry_out(tasks)) as batches:
                for batch in batches:
                    journal.keep(batch.done)
                    lost += batch.lost
                    watch(sum(len(missing[one.key]) for one in batch.done))
            rows = read_journal(out / JOURNAL).rows
            return _tell(out, _finished(plan, out, carrier, _as_it_is(account, missing, lost, rows), rows))
        except BaseException:
            with suppress(InputError):  # if the disk is full, the older account stays
                rows = read_journal(out / JOURNAL).rows
                _tell(out, replace(_as_it_is(account, missing, lost, rows), status="stopped"))
            raise


_Missing = Mapping[str, Sequence["StudyCell"]]
"""By key, all cells with the same episode."""
_Rows = Mapping[str, Sequence[StudyRow]]
"""By key, the rows of an ended episode."""


def _begun(plan: StudyPlan, out: Path, carrier: EpisodeRunner) -> tuple[_Missing, StudyRunAnswer]:
    """Episodes missing in the journal, and an account of the start."""
    journal = read_journal(out / JOURNAL)
    missing: dict[str, list[StudyCell]] = {}
    there: set[str] = set()
    for cell in plan.cells():
        key = cell.key(carrier.installed.code, carrier.installed.fingerprint)
        if key in journal.rows:
            there.add(key)
        else:
            missing.setdefault(key, []).append(cell)
    account = StudyRunAnswer(
        study=plan.written.name,
        statement=STATEMENT,
        status="begun",
        episodes=plan.episodes,
        different=len(there) + len(missing),
        done=plan.episodes - sum(map(len, missing.values())),
        run_now=0,
        damaged_lines=len(journal.damaged),
        damaged_at=tuple(f"{out / JOURNAL}:{number}" for number in journal.damaged),
        other=len(journal.rows) - len(there),
        failed=0,
        rows=0,
        lost_workers=0,
        version=version("comity"),
        code=carrier.installed.code,
        fingerprint=carrier.installed.fingerprint,
        folder=str(out),
        file=str(plan.file.path.absolute()),
        files=(),
    )
    write_whole(out / WRITTEN, plan.file.text.encode(), private=True)
    return missing, _tell(out, account)


def _as_it_is(account: StudyRunAnswer, missing: _Missing, lost: int, rows: _Rows) -> StudyRunAnswer:
    """The account updated from the journal."""
    ended = missing.keys() & rows.keys()
    done = account.done + sum(len(missing[key]) for key in ended)
    return replace(account, done=done, run_now=len(ended), lost_workers=lost)


def _finished(
    plan: StudyPlan, out: Path, carrier: EpisodeRunner, account: StudyRunAnswer, rows: _Rows
) -> StudyRunAnswer:
    """Write the tables from the journal, and return the final account."""
    installed = carrier.installed
    keyed = [(cell, cell.key(installed.code, installed.fingerprint)) for cell in plan.cells()]
    found = [(cell, key, rows[key]) for cell, key in keyed if key in rows]
    table = study_table(factors_of(plan), found, installed, account.version)
    files = tuple(_written(out, table))
    return replace(
        account,
        status="done" if len(found) == plan.episodes else "stopped",
        failed=sum(any(row["outcome"] == ERROR for row in measured) for _, _, measured in found),
        rows=len(table.rows),
        files=files,
    )


def _written(out: Path, table: StudyTable) -> Iterator[str]:
    """Write the tables, and yield their names."""
    write_whole(out / DICTIONARY, table.dictionary().encode(), private=True)
    write_whole(out / RESULTS, table.csv().encode(), private=True)
    yield from (RESULTS, DICTIONARY)
    if has_pyarrow():
        with written_whole(out / PARQUET, private=True) as part:
            write_parquet(table, part)
        yield PARQUET
    else:
        (out / PARQUET).unlink(missing_ok=True)  # remove an outdated table
    yield from (JOURNAL, ACCOUNT, WRITTEN)


def _tell(out: Path, account: StudyRunAnswer) -> StudyRunAnswer:
    """Write the account."""
    write_whole(out / ACCOUNT, as_text(account).encode(), private=True)
    return account
