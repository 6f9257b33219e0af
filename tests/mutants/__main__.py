"""Change the software one small thing at a time; do the shipped scenarios notice? `make mutants`."""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.mutants import python_mutations, rule_mutations
from tests.mutants.mutation import Mutation

ROOT = Path(__file__).parents[2]
PACKAGES = {"comity": ".", "domain": "domain", "executor": "executor", "fis": "fis", "sim2d": "sim2d"}
SHARES = {"rulebook": 25, "fis": 15, "domain": 25, "executor": 25, "sim2d": 25, "comity": 10}
"""How many of each, out of 125."""
TIMEOUT_S = 900
TALKS = ("/report/", "/testing/", "/commands/", "/replay/", "errors.py", "yaml_file.py", "wording.py")
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
    with TemporaryDirectory(prefix="comity-mutants-") as folder:
        executed = executed_lines(Path(folder))
        chosen = list(selected(executed, options.count, options.seed))
        with ThreadPoolExecutor(options.jobs) as pool:
            outcomes = list(pool.map(lambda pair: _tried(*pair, Path(folder)), enumerate(chosen)))
    text = table(outcomes, options.seed)
    print(text)
    if options.out:
        options.out.write_text(text, encoding="utf-8")


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make mutants", description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=125)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, help="a Markdown file for the table")
    return parser.parse_args()


def _environment(root: Path, scratch: Path) -> dict[str, str]:
    paths = [str(root), *(str(root / name) for name in PACKAGES.values() if name != ".")]
    own = {"PYTHONPATH": os.pathsep.join(paths), "COMITY_HOME": str(scratch / "kept")}
    return {**os.environ, **own, "COMITY_CACHE": str(scratch / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}


def _copied(to: Path) -> Path:
    for name in ("comity", "domain", "executor", "fis", "sim2d"):
        shutil.copytree(ROOT / name, to / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(Path(__file__).with_name("attempt.py"), to / "attempt.py")
    return to


def executed_lines(folder: Path) -> dict[str, set[int]]:
    """By file, the lines that the first scenarios of the library execute."""
    root = _copied(folder / "measured")
    data = folder / "coverage.json"
    command = [
        sys.executable,
        "-m",
        "coverage",
        "run",
        f"--data-file={folder / 'coverage'}",
        "--source",
        str(root),
    ]
    done = subprocess.run(
        [*command, "attempt.py", "--few"],
        cwd=root,
        env=_environment(root, folder),
        check=True,
        capture_output=True,
        text=True,
    )
    if _answer(done)["caught"]:
        sys.exit(f"The library fails without any change:\n{done.stdout}")
    subprocess.run(
        [
            sys.executable,
            "-m",
            "coverage",
            "json",
            f"--data-file={folder / 'coverage'}",
            "-o",
            str(data),
            "-q",
        ],
        cwd=root,
        check=True,
        capture_output=True,
    )
    files = json.loads(data.read_text())["files"]
    shutil.rmtree(root)
    return {name: set(found["executed_lines"]) for name, found in files.items()}


def selected(executed: dict[str, set[int]], count: int, seed: int) -> Iterator[Mutation]:
    """So many of each package, at random, no two in one line."""
    choose = random.Random(seed)
    for package, share in SHARES.items():
        found = list(_mutations(package, executed))
        choose.shuffle(found)
        lines: set[tuple[str, int, str]] = set()
        wanted = round(share * count / sum(SHARES.values()))
        for mutation in found:
            place = (mutation.file, mutation.line, mutation.family if package == "rulebook" else "")
            if len(lines) < wanted and place not in lines:
                lines.add(place)
                yield mutation


def _mutations(package: str, executed: dict[str, set[int]]) -> Iterator[Mutation]:
    if package == "rulebook":
        yield from rule_mutations.mutations(ROOT)
        return
    top = f"{package}/"
    for file, lines in sorted(executed.items()):
        if file.startswith(top) and file.endswith(".py") and not any(part in file for part in TALKS):
            yield from python_mutations.mutations(ROOT, file, package, lines)


def _tried(number: int, mutation: Mutation, folder: Path) -> Outcome:
    root = _copied(folder / f"copy-{number}")
    mutation.apply(root)
    try:
        done = subprocess.run(
            [sys.executable, "attempt.py"],
            cwd=root,
            env=_environment(root, folder / f"scratch-{number}"),
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        found = {"caught": "no end", "text": "", "tried": 0}
    else:
        found = _answer(done)
    shutil.rmtree(root)
    text = found["text"].lower()
    named = any(word.lower() in text for word in mutation.culprits)
    outcome = Outcome(mutation, found["caught"], named, found["text"], found["tried"])
    print(_line(outcome), file=sys.stderr, flush=True)
    return outcome


def _answer(done: subprocess.CompletedProcess[str]) -> dict:
    last = done.stdout.strip().splitlines()[-1:] or [""]
    if done.returncode == 0 and last[0].startswith("{"):
        return json.loads(last[0])
    return {"caught": "refused" if "InputError" in done.stderr else "crash", "text": done.stderr, "tried": 0}


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
