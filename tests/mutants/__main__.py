"""Change the software one small thing at a time; do the scenarios notice? `make mutants`."""

from __future__ import annotations

import argparse
from concurrent.futures import ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.mutants.attempt import TURNS
from tests.mutants.bench import Bench
from tests.mutants.mutation import Mutation
from tests.mutants.outcome import Outcome, table
from tests.mutants.progress import say
from tests.mutants.reach import covered
from tests.mutants.selection import SHARES, candidates, left_out, names_read, reaching, selected

LIBRARIES = [
    "numpy",
    "pydantic",
    "yaml",
    "lark",
    "shapely",
    "pymunk",
    "py_trees",
    "scipy.sparse.csgraph",
    "unified_planning.shortcuts",
    "rich.console",
]
"""Imported once, in the process from which every attempt is forked."""

RANDOM = 260
"""Numbers to draw random scenarios from; about one in ten is refused."""


def main() -> None:
    """Choose, try, tell."""
    options = _options()
    context = get_context("forkserver")
    context.set_forkserver_preload(LIBRARIES)
    with TemporaryDirectory(prefix="comity-mutants-") as folder:
        bench = Bench(options.bench or Path(folder), context, options.turns, options.random)
        scenarios = bench.measure()
        say(f"choosing {options.count} changes")
        chosen = [
            one
            for one in selected(bench.unchanged, scenarios, options.count, options.seed)
            if not (options.package and one.package not in options.package)
            and not (options.only and f"{one.file}:{one.line}" not in options.only)
        ]

        def tried(number: int, mutation: Mutation) -> Outcome:
            say(f"change {number + 1} of {len(chosen)}: {mutation.file}:{mutation.line} {mutation.shown}")
            return bench.tried(number, mutation, reaching(bench.unchanged, mutation, scenarios))

        with ThreadPoolExecutor(options.jobs) as pool:
            outcomes = list(pool.map(tried, range(len(chosen)), chosen))
        say("counting what else could be changed")
        reached = covered(bench.folder / "measured")
        read = names_read(bench.unchanged, scenarios)
        places = sum(1 for each in SHARES for _ in candidates(bench.unchanged, each, scenarios, read))
        text = table(outcomes, options.seed, reached, places, left_out(bench.unchanged, scenarios))
    print(text)
    if options.out:
        options.out.write_text(text, encoding="utf-8")


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make mutants", description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--count",
        type=int,
        default=125,
        help="so many of all packages; `--package` and `--only` leave some out",
    )
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--bench", type=Path, metavar="DIR", help="keep there what was measured, or use it")
    parser.add_argument("--turns", type=int, default=TURNS, help="for so many profiles each, at most")
    parser.add_argument(
        "--random",
        type=int,
        default=RANDOM,
        help="draw so many random scenarios to tell what survives from the original; 0: none",
    )
    parser.add_argument("--package", nargs="+", choices=SHARES, help="of those chosen, only these packages'")
    parser.add_argument("--only", nargs="+", metavar="FILE:LINE", help="of those chosen, only these")
    parser.add_argument("--out", type=Path, help="a Markdown file for the table")
    return parser.parse_args()


if __name__ == "__main__":
    main()
