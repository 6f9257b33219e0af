"""The rows of a study, on all cores: what was computed once by the same code is read, not computed again.

A line of JSON for each row is in `.studies/NAME.jsonl`, synced before the next one counts; a study that was
stopped or killed goes on with what is missing.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
from collections.abc import Callable, Hashable, Iterable
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from comity.system.installed_code import installed_code

FOLDER = Path(__file__).parents[1] / ".studies"


def studied(
    name: str, row: Callable[..., Any], cases: Iterable[tuple[Hashable, ...]], jobs: int | None = None
) -> list[Any]:
    """The rows of all cases, in their order.

    Args:
        name: Of the study; its file is called so.
        row: Function of a module that computes a row, which JSON can hold, from the arguments of a case.
        cases: Arguments of `row`, which JSON can hold.
        jobs: Number of processes; as many as there are cores without it.
    """
    FOLDER.mkdir(exist_ok=True)
    file, cases = FOLDER / f"{name}.jsonl", list(cases)
    code = _code(row)
    known = _whole_lines(file, code)
    missing = [case for case in cases if json.dumps(case) not in known]
    with file.open("a", encoding="utf-8") as journal, ProcessPoolExecutor(jobs or os.cpu_count()) as pool:
        running = {pool.submit(row, *case): case for case in missing}
        for done, future in enumerate(as_completed(running), start=1):
            key = json.dumps(running[future])
            known[key] = future.result()
            journal.write(json.dumps({"code": code, "case": key, "row": known[key]}) + "\n")
            journal.flush()
            os.fsync(journal.fileno())
            if sys.stderr.isatty():
                print(f"\r{name}: {done} of {len(missing)}", end="", file=sys.stderr, flush=True)
    return [known[json.dumps(case)] for case in cases]


def _code(row: Callable[..., Any]) -> str:
    """Digest of the installed code and of the studies and their judge, which are files beside this one."""
    digest = hashlib.sha256(installed_code().encode())
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return f"{row.__qualname__} {digest.hexdigest()}"


def _whole_lines(file: Path, code: str) -> dict[str, Any]:
    """The rows of this code by case; a line that was being written when a study was killed is taken off."""
    if not file.exists():
        return {}
    text = file.read_text(encoding="utf-8")
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        file.write_text(whole, encoding="utf-8")
    rows = map(json.loads, whole.splitlines())
    return {line["case"]: line["row"] for line in rows if line["code"] == code}
