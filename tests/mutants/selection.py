"""Which changes are tried: so many of each package, by a seed, in lines that scenarios execute."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from hashlib import sha256
from pathlib import Path

from tests.mutants import python_mutations, rule_mutations
from tests.mutants.mutation import Mutation
from tests.mutants.reach import Reach

SHARES = {"rulebook": 25, "fis": 15, "domain": 25, "executor": 25, "sim2d": 25, "comity": 10}
"""How many of each, out of 125."""
TALKS = (
    "/report/",
    "/testing/",
    "/commands/",
    "/replay/",
    "/metrics/",
    "errors.py",
    "yaml_file.py",
    "wording.py",
    "reason.py",
    "evidence.py",
    "cause.py",
    "history.py",
)
"""What only tells of an episode, reasons in words, measures or judges it: no scenario can see it."""
KEEPS_HOUSE = ("workspace.py", "process.py", "store.py", "private_files.py", "run_folder.py")
"""Files, folders and processes around a run: an episode does not depend on them."""
REFUSES = ("check.py",)
"""What refuses bad input: the scenarios are valid."""
FILES = {
    python_mutations.REASONS: TALKS,
    "keeps house on the disk": KEEPS_HOUSE,
    python_mutations.REFUSALS: REFUSES,
}
"""By the reason why nothing is changed in them, parts of the names of files."""


def selected(root: Path, scenarios: Mapping[str, Reach], count: int, seed: int) -> Iterator[Mutation]:
    """So many of each package, no two in one line; what is elsewhere in the software does not matter.

    Args:
        root: The software.
        scenarios: What they execute.
        count: Of all packages.
        seed: Another one chooses others.
    """
    read = names_read(root, scenarios)
    for package, wanted in shared_out(count).items():
        places: set[tuple[object, ...]] = set()
        for mutation in sorted(candidates(root, package, scenarios, read), key=lambda one: _drawn(one, seed)):
            place = (mutation.file, mutation.line, mutation.family if package == "rulebook" else "")
            if len(places) < wanted and place not in places:
                places.add(place)
                yield mutation


def shared_out(count: int) -> Mapping[str, int]:
    """How many of each package, together exactly so many: the largest rests are rounded up."""
    exact = {package: share * count / sum(SHARES.values()) for package, share in SHARES.items()}
    whole = {package: int(each) for package, each in exact.items()}
    rests = sorted(SHARES, key=lambda package: whole[package] - exact[package])
    for package in rests[: count - sum(whole.values())]:
        whole[package] += 1
    return whole


def _drawn(mutation: Mutation, seed: int) -> str:
    """A number drawn for a change, by what it changes and not by where that stands: files may be moved."""
    file = Path(mutation.file)
    inside = next((i for i, part in enumerate(file.parts) if part.startswith("comity")), 0)
    module = "/".join((*file.parts[: inside + 1], file.name)) if file.suffix == ".py" else mutation.file
    return sha256(f"{seed} {module} {mutation.family} {mutation.shown}".encode()).hexdigest()


def candidates(
    root: Path, package: str, scenarios: Mapping[str, Reach], read: Collection[str]
) -> Iterator[Mutation]:
    """All changes of a package that a scenario may notice; `read` is what `names_read` gives."""
    if package == "rulebook":
        yield from rule_mutations.mutations(root)
        return
    for file in sorted({file for one in scenarios.values() for file in one.lines}):
        if file.startswith(f"{package}/") and is_judged(file) and (lines := _lines(root, file, scenarios)):
            yield from python_mutations.mutations(root, file, package, lines, read)


def left_out(root: Path, scenarios: Mapping[str, Reach]) -> Mapping[str, int]:
    """How many places of the whole software are left out, by the rule."""
    counts: Counter[str] = Counter()
    read = names_read(root, scenarios)
    for package in SHARES:
        for path in sorted((root / package).rglob("*.py")) if (root / package).is_dir() else ():
            file = str(path.relative_to(root))
            if rule := _rule(file):
                everything = range(path.read_text(encoding="utf-8").count("\n") + 2)
                counts[rule] += len(list(python_mutations.mutations(root, file, package, everything)))
                counts[rule] += sum(python_mutations.left_out(root, file, package, everything).values())
            else:
                lines = _lines(root, file, scenarios)
                counts += Counter(python_mutations.left_out(root, file, package, lines, read))
    return counts


def names_read(root: Path, scenarios: Mapping[str, Reach]) -> Collection[str]:
    """The names that executed functions read, and what stands outside of functions."""
    names: set[str] = set()
    for file in {file for one in scenarios.values() for file in one.lines if file.endswith(".py")}:
        lines = _lines(root, file, scenarios) or at_import(root, file)
        for node in ast.walk(ast.parse((root / file).read_text(encoding="utf-8"))):
            loads = isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load)
            if loads and node.lineno in lines:
                names.add(node.id if isinstance(node, ast.Name) else node.attr)
    return names


def _lines(root: Path, file: str, scenarios: Mapping[str, Reach]) -> Collection[int]:
    """The lines of a file that are executed, imports included; none where no function of it is used."""
    executed = {line for one in scenarios.values() for line in one.lines.get(file, ())}
    imported = at_import(root, file)
    return executed | imported if executed - imported else ()


def is_judged(file: str) -> bool:
    """Whether scenarios are to notice changes of a file."""
    return file.endswith(".py") and not _rule(file)


def _rule(file: str) -> str | None:
    """Why nothing is changed in a file."""
    return next((rule for rule, parts in FILES.items() if any(part in file for part in parts)), None)


def reaching(root: Path, mutation: Mutation, scenarios: Mapping[str, Reach]) -> dict[str, Reach]:
    """The scenarios that execute a changed line, the profiles that do first; all where importing does."""
    if mutation.package == "rulebook" or mutation.line in at_import(root, mutation.file):
        return dict(scenarios)
    file, line = mutation.file, mutation.line
    return {
        name: one.through(file, line) for name, one in scenarios.items() if line in one.lines.get(file, ())
    }


def at_import(root: Path, file: str) -> set[int]:
    """The lines of a file outside all functions."""
    text = (root / file).read_text(encoding="utf-8")
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
