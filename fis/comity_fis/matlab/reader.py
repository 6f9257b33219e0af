"""Reads a `.fis` file into a rulebook, with a declared choice for what the format cannot express.

A `.fis` file names no sources, units, or people. The rulebook's only source is the file itself, evidence
`design`. Variables are of kind `situation`, since nothing says that they describe a person. The neutral value
is the middle of the range, as in MATLAB if no rule fires. A person may ask for any value in the range.

In a zero-order Sugeno system output terms are constants: singletons, scaled by their rules' strengths,
summed, and averaged.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import partial
from math import inf, sqrt
from pathlib import Path

from comity_fis.errors import WrongValueError, closest
from comity_fis.matlab.lines import (
    MAX_RULES,
    MAX_VARIABLES,
    MatlabLine,
    Section,
    read_text,
    sections_of,
)
from comity_fis.matlab.rows import negated, read_rows
from comity_fis.membership.curved import CURVED
from comity_fis.membership.function import Complement, NumericMembership, Singleton, Trapezoid
from comity_fis.membership.interval import Interval
from comity_fis.rulebook.models import LONGEST_NAME, MAX_TERMS, NAME_PATTERN
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rules.methods import CHOICES, Methods
from comity_fis.rules.rule import And, Or, Rule, Source
from comity_fis.variables.measurement import Level
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NumericVariable

METHOD_KEYS = {
    "AndMethod": "conjunction",
    "OrMethod": "disjunction",
    "ImpMethod": "implication",
    "AggMethod": "aggregation",
    "DefuzzMethod": "defuzzification",
}
OF_SUGENO = {"implication": "prod", "aggregation": "sum", "defuzzification": "centroid"}
"""MATLAB's methods for a Sugeno system, whatever its file says."""

UNUSED = {"conjunction": And, "disjunction": Or}
"""Methods that only some rules need, each with the kind of condition that needs it."""

COUNT_KEYS = ("NumInputs", "NumOutputs", "NumRules")
STRAIGHT = {"trimf": 3, "trapmf": 4, "linsmf": 2, "linzmf": 2}
"""MATLAB's piecewise linear membership functions, with their number of parameters."""

SUGENO = ("constant", "linear")
"""Terms of a Sugeno output: a constant, or a linear function of the inputs."""

TERM = re.compile(r"('[^']*'|\"[^\"]*\")\s*:\s*('[^']*'|\"[^\"]*\")\s*,\s*(\[[^\]]*\]|[-+.\w]+)")
UNIT = "units"
"""Placeholder unit: the file has none."""
MakeTerm = Callable[[MatlabLine, str, tuple[float, ...], Interval], NumericMembership]
"""Makes a term from a line, the term's type, its numbers and the variable's range."""


def read_fis(path: Path, name: str | None = None) -> Rulebook:
    """The rulebook that a `.fis` file describes.

    Args:
        path: The file.
        name: Name of the file in messages; None: the path.

    Raises:
        InputError: The file contains something that a rulebook cannot express; with file and line.
    """
    name = name or str(path)
    return parse_fis(read_text(path, name), name)


def parse_fis(text: str, name: str) -> Rulebook:
    """The rulebook that the text of a `.fis` file describes.

    Args:
        text: The whole text.
        name: Name of the file in messages.

    Raises:
        InputError: The text contains something that a rulebook cannot express; with file and line.
    """
    sections = sections_of(text, name)
    system = _system(sections)
    sugeno = system.entry("Type").words().lower() == "sugeno"
    inputs = [_variable(section) for section in _numbered(sections, system, "Input")]
    constant = partial(_constant, len(inputs)) if sugeno else None
    outputs = [_variable(section, constant) for section in _numbered(sections, system, "Output")]
    _refuse_twins(inputs, outputs)
    source = Source(
        "file", f"{Path(name).name}, a .fis file of MATLAB", "its text only; it does not say what it rests on"
    )
    rules = read_rows(
        _rules(sections, system),
        inputs={v.name: tuple(v.terms) for v in inputs},
        outputs={v.name: tuple(v.terms) for v in outputs},
        source=source,
        constants=sugeno,
    )
    if not rules:
        raise system.entry("NumRules").wrong("a rule that concludes something", "Give one an output's index.")
    concluded = {(is_.name, is_.term) for rule in rules for is_ in rule.consequents}
    return Rulebook(
        name=_title(system, name),
        description=f"Read from {Path(name).name}, a .fis file of MATLAB.",
        variables={v.name: v.as_variable() for v in inputs},
        parameters={v.name: v.as_parameter(concluded) for v in outputs},
        rules=rules,
        sources={source.key: source},
        methods=_methods(system, rules, sugeno=sugeno),
    )


@dataclass(frozen=True, slots=True)
class _Variable:
    """An input or an output, not yet distinguished."""

    name: str
    range: Interval
    terms: Mapping[str, NumericMembership]
    section: Section
    sugeno: bool
    """Whether its terms are the constants of a Sugeno system."""

    def as_variable(self) -> NumericVariable:
        return NumericVariable(
            name=self.name,
            kind="situation",
            level=Level.INTERVAL,
            domain=self.range,
            terms=self.terms,
            unit=None,
            reason="From the .fis file, which gives no reasons.",
        )

    def as_parameter(self, concluded: set[tuple[str, str]]) -> NumericParameter:
        terms = dict(self.terms)
        for term, membership in self.terms.items():
            if (self.name, negated(term)) in concluded:
                terms[negated(term)] = Complement(membership)
        reach = self._reach
        low, high = reach.ends
        try:
            return NumericParameter(
                name=self.name,
                kind="behaviour",
                unit=UNIT,
                rules=reach,
                ask=reach,
                safe=reach,
                terms=terms,
                neutral=sum(self.range.ends) / 2,
                spread=(high - low) / sqrt(12),
                reasons={
                    "ranges": "From the .fis file; ask and safe are the same range: our choice.",
                    "terms": "From the .fis file, which gives no reasons.",
                    "neutral": "The middle of the range: MATLAB's answer where no rule fires.",
                    "spread": "Of a uniform distribution over the range: our choice, the file says nothing.",
                },
            )
        except WrongValueError as error:
            raise error.at(self.section.where) from None

    @property
    def _reach(self) -> Interval:
        """The range, extended to constants outside it: MATLAB does not clip a Sugeno output to its range."""
        if not self.sugeno:
            return self.range
        places = [place for term in self.terms.values() for place in term.knots]
        return Interval(min(self.range.low, *places), max(self.range.high, *places)) if places else self.range


def _system(sections: Mapping[str, Section]) -> Section:
    system = sections.get("System")
    if system is None:
        first = next(iter(sections.values()))
        raise MatlabLine(f"[{first.name}]", first.where).wrong(
            "a section [System]", "Add it; the file may be cut off."
        )
    kind = system.entry("Type")
    if kind.words().lower() not in {"mamdani", "sugeno"}:
        raise kind.wrong(
            "Type='mamdani', or Type='sugeno' with outputs that are constants",
            "Type-2 systems and other types are not read: convert it in MATLAB first.",
        )
    for key, entry in system.entries.items():
        if key.lower().startswith("typered"):
            raise entry.wrong("a type-1 system", "Type-2 systems are not read: convert it in MATLAB first.")
    system.refuse_others(("Name", "Type", "Version", *COUNT_KEYS, *METHOD_KEYS))
    return system


def _title(system: Section, file: str) -> str:
    entry = system.entry("Name")
    return _checked_name(entry, entry.words().strip() or Path(file).stem)


def _methods(system: Section, rules: Sequence[Rule], *, sugeno: bool) -> Methods:
    """The methods; an empty one, as some programs write, is MATLAB's default if no rule needs it."""
    chosen: dict[str, str] = {}
    needed = {type(rule.antecedent) for rule in rules}
    for key, method in METHOD_KEYS.items():
        if sugeno and method in OF_SUGENO:
            chosen[method] = OF_SUGENO[method]
            continue
        entry = system.entry(key)
        chosen[method] = entry.words()
        unused = UNUSED.get(method)
        if not chosen[method] and unused is not None and unused not in needed:
            chosen[method] = CHOICES[method][0]
        if chosen[method] not in CHOICES[method]:
            raise entry.wrong(
                f"{key} to be one of {', '.join(CHOICES[method])}",
                f"{closest(chosen[method], CHOICES[method])} Functions of one's own are not read.",
            )
    if sugeno:
        averaged = system.entry("DefuzzMethod")
        if averaged.words() != "wtaver":
            raise averaged.wrong(
                "DefuzzMethod='wtaver' in a Sugeno system",
                "Sums of constants (wtsum) leave the output's range, and are not read.",
            )
    return Methods(**chosen)  # type: ignore[arg-type]  # checked just above


def _numbered(sections: Mapping[str, Section], system: Section, kind: str) -> list[Section]:
    """The sections `[Input1]`, `[Input2]`, ...: as many as the system declares, and no others."""
    counted = system.entry(f"Num{kind}s")
    count = counted.count(MAX_VARIABLES)
    wanted = [f"{kind}{i}" for i in range(1, count + 1)]
    for name in wanted:
        if name not in sections:
            raise counted.wrong(f"a section [{name}]", "Add it; the file may be cut off.")
    for name, section in sections.items():
        if name.startswith(kind) and name not in wanted:
            raise MatlabLine(f"[{name}]", section.where).wrong(
                f"{count} sections [{kind}...]", f"Correct Num{kind}s, or remove it."
            )
    return [sections[name] for name in wanted]


def _rules(sections: Mapping[str, Section], system: Section) -> list[MatlabLine]:
    counted = system.entry("NumRules")
    count = counted.count(MAX_RULES)
    rows = sections["Rules"].rows if "Rules" in sections else []
    if len(rows) != count:
        raise counted.wrong(
            f"NumRules to be the number of rules, {len(rows)}", "Correct it; the file may be cut off."
        )
    return rows


def _variable(section: Section, constant: MakeTerm | None = None) -> _Variable:
    """An input or an output; `constant` makes the terms of a Sugeno output."""
    entry = section.entry("Range")
    ends = entry.numbers(entry.text)
    if len(ends) != 2 or not -inf < ends[0] < ends[1] < inf:
        raise entry.wrong("two finite numbers, the lower one first", "Write for example [0 10].")
    domain = Interval(*ends)
    keys = [f"MF{i}" for i in range(1, section.entry("NumMFs").count(MAX_TERMS, least=0) + 1)]
    section.refuse_others(("Name", "Range", "NumMFs", *keys))
    terms: dict[str, NumericMembership] = {}
    for key in keys:
        line = section.entry(key)
        name, term = _term(line, domain, constant or _membership)
        if name in terms:
            raise line.wrong("each term's name once in a variable", "Rename one of them.")
        terms[name] = term
    named = section.entry("Name")
    return _Variable(_checked_name(named, named.words()), domain, terms, section, constant is not None)


def _term(line: MatlabLine, domain: Interval, make: MakeTerm) -> tuple[str, NumericMembership]:
    match = TERM.fullmatch(line.text)
    if match is None:
        raise line.wrong(
            "a term such as 'poor':'trimf',[0 0 5]",
            "Two vectors (a type-2 system) are not read: convert it in MATLAB first.",
        )
    name, kind = (MatlabLine(part, line.where).words() for part in match.groups()[:2])
    numbers = line.numbers(match[3] if match[3].startswith("[") else f"[{match[3]}]")
    try:
        return _checked_name(line, name), make(line, kind, numbers, domain)
    except WrongValueError as error:
        raise error.at(line.where) from None


def _constant(
    inputs: int, line: MatlabLine, kind: str, numbers: tuple[float, ...], _: Interval
) -> NumericMembership:
    """The term of a Sugeno output."""
    if kind not in SUGENO:
        raise line.wrong("'constant' in an output of a Sugeno system", "Or write Type='mamdani'.")
    count = 1 if kind == "constant" else inputs + 1
    if len(numbers) != count:
        raise line.wrong(f"{count} parameters of {kind}", "Correct the line.")
    *slopes, constant = numbers
    if any(slopes):
        raise line.wrong(
            "constants as the terms of a Sugeno output (order 0)",
            "Outputs that depend on inputs (order 1) are not read: a rulebook's terms are fuzzy sets.",
        )
    return Singleton(constant)


def _membership(
    line: MatlabLine, kind: str, numbers: tuple[float, ...], domain: Interval
) -> NumericMembership:
    known = STRAIGHT | {name: len(fields(shape)) for name, shape in CURVED.items()}
    if kind not in known:
        raise line.wrong(
            "one of MATLAB's membership functions",
            "It stands in outputs of files with Type='sugeno' only."
            if kind in SUGENO
            else f"{closest(kind, known)} Functions of one's own are not read.",
        )
    if len(numbers) != known[kind]:
        raise line.wrong(f"{known[kind]} parameters of {kind}", "Correct the line.")
    if kind in CURVED:
        return CURVED[kind](*numbers)
    corners = _corners(kind, numbers, domain)
    return Singleton(corners[0]) if len(set(corners)) == 1 else Trapezoid(*corners)


def _corners(kind: str, numbers: tuple[float, ...], domain: Interval) -> tuple[float, ...]:
    """Corners of the trapezoid that equals the function over the variable's range."""
    match kind:
        case "trimf":
            a, b, d = numbers
            c = b
        case "linsmf":
            a, b, c, d = *numbers, inf, inf
        case "linzmf":
            a, b, c, d = -inf, -inf, *numbers
        case _:
            a, b, c, d = numbers
    if a == b == -inf:
        a = b = min(domain.low, c)
    if c == d == inf:
        c = d = max(domain.high, b)
    return a, b, c, d


def _checked_name(entry: MatlabLine, name: str) -> str:
    """The name without the surrounding blanks that MATLAB's editor keeps."""
    name = name.strip()
    if not re.fullmatch(NAME_PATTERN, name) or len(name) > LONGEST_NAME:
        raise entry.wrong(
            f"a name of 1 to {LONGEST_NAME} characters without quotes",
            "Rename it.",
        )
    return name


def _refuse_twins(inputs: list[_Variable], outputs: list[_Variable]) -> None:
    seen: set[str] = set()
    for variable in (*inputs, *outputs):
        if variable.name in seen:
            raise variable.section.entry("Name").wrong(
                "each name once among inputs and outputs",
                "Rename one of them: rules tell them apart by name.",
            )
        seen.add(variable.name)
