"""Change the software one small thing at a time; do the shipped scenarios notice? `make mutants`."""

from __future__ import annotations

import argparse
import ast
import json
import os
import random
import shutil
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.mutants import python_mutations, reach, rule_mutations
from tests.mutants.attempt import TURNS, attempt
from tests.mutants.mutation import Mutation
from tests.mutants.reach import Reach

ROOT = Path(__file__).parents[2]
PACKAGES = ("comity", "domain", "executor", "fis", "sim2d")
SHARES = {"rulebook": 25, "fis": 15, "domain": 25, "executor": 25, "sim2d": 25, "comity": 10}
"""How many of each, out of 125."""
TIMEOUT_S = 1800
LIBRARIES = [
    "numpy",
    "pydantic",
    "yaml",
    "lark",
    "shapely",
    "pymunk",
    "py_trees",
    "scipy.sparse.csgraph",
    "scipy.ndimage",
    "unified_planning.shortcuts",
    "rich.console",
]
"""Imported once, in the process from which every attempt is forked."""
TALKS = (
    "/report/",
    "/testing/",
    "/commands/",
    "/replay/",
    "errors.py",
    "yaml_file.py",
    "wording.py",
    "reason.py",
)
"""What only talks about an episode, or judges it, is not what scenarios are to judge."""


@dataclass(frozen=True)
class Outcome:
    """What the library said about one change."""

    mutation: Mutation
    caught_by: str | None
    named: bool
    text: str
    tried: int


def main() -> None:
    """Choose, try, tell."""
    options = _options()
    context = get_context("forkserver")
    context.set_forkserver_preload(LIBRARIES)
    with TemporaryDirectory(prefix="comity-mutants-") as folder:
        bench = Bench(options.bench or Path(folder), context, options.turns)
        scenarios = bench.measure()
        chosen = list(selected(scenarios, options.count, options.seed))
        if options.package:
            chosen = [one for one in chosen if one.package in options.package]
        if options.only:
            chosen = [one for one in chosen if f"{one.file}:{one.line}" in options.only]
        with ThreadPoolExecutor(options.jobs) as pool:
            outcomes = list(
                pool.map(lambda pair: bench.tried(*pair, reaching(pair[1], scenarios)), enumerate(chosen))
            )
    text = table(outcomes, options.seed)
    print(text)
    if options.out:
        options.out.write_text(text, encoding="utf-8")


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make mutants", description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=125)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--bench", type=Path, metavar="DIR", help="keep there what was measured, or use it")
    parser.add_argument("--turns", type=int, default=TURNS, help="for so many profiles each, at most")
    parser.add_argument("--package", nargs="+", choices=SHARES, help="of those chosen, only these packages'")
    parser.add_argument("--only", nargs="+", metavar="FILE:LINE", help="of those chosen, only these")
    parser.add_argument("--out", type=Path, help="a Markdown file for the table")
    return parser.parse_args()


@dataclass(frozen=True)
class Bench:
    """A folder with an unchanged copy of the software, and processes that try changed ones."""

    folder: Path
    context: object
    turns: int

    def measure(self) -> dict[str, Reach]:
        """What each scenario reaches, and that the library holds without any change."""
        if not (self.folder / "measured").exists():
            for name in PACKAGES:
                shutil.copytree(ROOT / name, self._unchanged / name)
            self._run(reach.measure, self._unchanged, self._scratch("measured"))
        scenarios = reach.read(self.folder / "measured")
        if failed := [text for one in scenarios.values() for text in one.failures]:
            sys.exit("The library fails without any change:\n" + "\n".join(failed))
        return scenarios

    def tried(self, number: int, mutation: Mutation, scenarios: Mapping[str, Reach]) -> Outcome:
        """The library against one change."""
        root, scratch = self.folder / f"copy-{number}", self._scratch(f"scratch-{number}")
        shutil.copytree(self._unchanged, root, copy_function=os.link)
        shutil.copytree(self.folder / "measured" / "cache", scratch / "cache")
        mutation.apply(root)
        self._run(attempt, root, scratch, dict(scenarios), self.turns)
        try:
            found = json.loads((scratch / "answer.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            found = {"caught": "no end", "text": "", "tried": 0}
        shutil.rmtree(root)
        shutil.rmtree(scratch)
        text = found["text"].lower()
        named = any(word.lower() in text for word in mutation.culprits)
        outcome = Outcome(mutation, found["caught"], named, found["text"], found.get("tried", 0))
        print(_line(outcome), f"({outcome.tried})", file=sys.stderr, flush=True)
        return outcome

    @property
    def _unchanged(self) -> Path:
        return self.folder / "unchanged"

    def _scratch(self, name: str) -> Path:
        (self.folder / name).mkdir(parents=True)
        return self.folder / name

    def _run(self, *task: object) -> None:
        """A task in a process of its own, which ends."""
        process = self.context.Process(target=task[0], args=task[1:])
        process.start()
        process.join(TIMEOUT_S)
        process.kill()
        process.join()


def selected(scenarios: Mapping[str, Reach], count: int, seed: int) -> Iterator[Mutation]:
    """So many of each package, at random, no two in one line."""
    choose = random.Random(seed)
    for package, share in SHARES.items():
        found = list(_mutations(package, scenarios))
        choose.shuffle(found)
        lines: set[tuple[str, int, str]] = set()
        wanted = round(share * count / sum(SHARES.values()))
        for mutation in found:
            place = (mutation.file, mutation.line, mutation.family if package == "rulebook" else "")
            if len(lines) < wanted and place not in lines:
                lines.add(place)
                yield mutation


def _mutations(package: str, scenarios: Mapping[str, Reach]) -> Iterator[Mutation]:
    if package == "rulebook":
        yield from rule_mutations.mutations(ROOT)
        return
    files = {file for one in scenarios.values() for file in one.lines}
    for file in sorted(files):
        if (
            file.startswith(f"{package}/")
            and file.endswith(".py")
            and not any(part in file for part in TALKS)
        ):
            executed = {line for one in scenarios.values() for line in one.lines.get(file, ())}
            yield from python_mutations.mutations(ROOT, file, package, executed | _at_import(file))


def reaching(mutation: Mutation, scenarios: Mapping[str, Reach]) -> dict[str, Reach]:
    """The scenarios that execute a changed line; all of them where importing does."""
    if mutation.package == "rulebook" or mutation.line in _at_import(mutation.file):
        return dict(scenarios)
    return {name: one for name, one in scenarios.items() if mutation.line in one.lines.get(mutation.file, ())}


def _at_import(file: str) -> set[int]:
    """The lines of a file outside all functions."""
    text = (ROOT / file).read_text(encoding="utf-8")
    inside = {
        line
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.FunctionDef | ast.Lambda)
        for line in range(
            node.body[0].lineno if isinstance(node, ast.FunctionDef) else node.lineno,
            (node.end_lineno or 0) + 1,
        )
    }
    return set(range(1, text.count("\n") + 2)) - inside


def _line(outcome: Outcome) -> str:
    mutation = outcome.mutation
    text = (ROOT / mutation.file).read_text(encoding="utf-8")
    shown = mutation.shown(text).replace("|", "\\|")
    caught = outcome.caught_by or "**survived**"
    named = "yes" if outcome.named else "no" if outcome.caught_by else "-"
    return f"| {mutation.file}:{mutation.line} | {mutation.family} | `{shown}` | {caught} | {named} |"


def table(outcomes: Sequence[Outcome], seed: int) -> str:
    """The report as Markdown."""
    packages = Counter(one.mutation.package for one in outcomes)
    caught = [one for one in outcomes if one.caught_by]
    named = [one for one in caught if one.named]
    lines = [
        f"{len(outcomes)} changes, chosen with seed {seed}: {len(caught)} caught "
        f"({len(caught) / max(1, len(outcomes)):.0%}), the text names the culprit in {len(named)} of these "
        f"({len(named) / max(1, len(caught)):.0%}).",
        "",
        "| package | changes | caught | culprit named |",
        "|---|---|---|---|",
    ]
    for package, count in packages.items():
        there = [one for one in caught if one.mutation.package == package]
        lines.append(f"| {package} | {count} | {len(there)} | {sum(one.named for one in there)} |")
    lines += ["", "| place | kind | change | caught by | culprit named |", "|---|---|---|---|---|"]
    lines += map(_line, outcomes)
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
