"""Which lines each shipped scenario executes, and how long it takes: only those can notice a change there."""

from __future__ import annotations

import functools
import gc
import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from tests.mutants.attempt import PROFILES, Library, Turn, settle


@dataclass(frozen=True)
class Reach:
    """One scenario."""

    takes_s: float
    """For one profile, on this machine."""
    profiles: tuple[str, ...]
    """For which it is tried; empty where it has none to choose from."""
    lines: dict[str, list[int]]
    """By file from the root: what it executes, imports left out."""
    failures: tuple[str, ...] = ()


def measure(root: Path, scratch: Path) -> None:
    """Go once through the library for one profile each, and write what it reaches into the scratch folder.

    Args:
        root: An unchanged copy of the software.
        scratch: For the answer.
    """
    settle(root, scratch)
    from coverage import Coverage

    from comity.library import shipped

    coverage = Coverage(data_file=None, source=[str(root)], config_file=False)
    found: dict[str, Reach] = {}
    library = Library()
    for i, name in enumerate(shipped("scenario")):
        profiles = _profiles(name)
        turn = Turn(name, profiles[i % len(profiles)] if profiles else None)
        quick = Library()
        _forget()
        start = time.process_time()
        failures = tuple(result.text for result in quick.results(turn) if not result.good)
        takes_s = time.process_time() - start
        _forget()
        coverage.erase()
        coverage.start()
        list(library.results(turn))
        coverage.stop()
        found[name] = Reach(takes_s, profiles, _lines(coverage, root), failures)
    text = json.dumps({name: asdict(reach) for name, reach in found.items()})
    (scratch / "reach.json").write_text(text, encoding="utf-8")


def _forget() -> None:
    """What is remembered within a process would hide from later scenarios what they reach."""
    for thing in gc.get_objects():
        if isinstance(thing, functools._lru_cache_wrapper):
            thing.cache_clear()


def read(scratch: Path) -> dict[str, Reach]:
    """What `measure` wrote."""
    found = json.loads((scratch / "reach.json").read_text(encoding="utf-8"))
    return {name: Reach(**{**one, "profiles": tuple(one["profiles"])}) for name, one in found.items()}


def _profiles(scenario: str) -> tuple[str, ...]:
    from comity.library import shipped
    from comity.testing.case import Across
    from comity.testing.cases import claims_in

    claims = claims_in(Path(shipped("scenario")[scenario]))
    cases = [claim.case for claim in claims if not isinstance(claim.case, Across)]
    own = {case.profile_name for case in cases if case.profile}
    return tuple(name for name in PROFILES if name in own)


def _lines(coverage: object, root: Path) -> dict[str, list[int]]:
    data = coverage.get_data()
    return {
        str(Path(file).relative_to(root)): sorted(data.lines(file) or ())
        for file in data.measured_files()
        if Path(file).is_relative_to(root)
    }
