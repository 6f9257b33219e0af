"""Converts a rulebook between file formats, and checks the result by reading it back."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from comity.answers.inference import ConvertAnswer
from comity.system.own_files import refuse_foreign, write_whole
from comity_fis import InputError, NumericParameter, Where, load_rulebook
from comity_fis.loading import is_fis
from comity_fis.matlab.check import compare
from comity_fis.matlab.reader import parse_fis
from comity_fis.matlab.writer import FIRST_LINE as FIS_LINE
from comity_fis.matlab.writer import write_fis
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rulebook.selection import selected
from comity_fis.rulebook.writer import FIRST_LINE as YAML_LINE
from comity_fis.rulebook.writer import rulebook_yaml
from comity_fis.validation.yaml_file import parse_yaml

CHOSEN = (
    "every input is of kind situation and level interval: nothing says that it tells who a person is",
    "the only source is the .fis file, evidence design",
    "the neutral value is the middle of the range, which MATLAB gives where no rule fires",
    "a person may ask for the whole range, and safety allows it",
    "the spread is that of a uniform distribution over the range, the unit is `units`",
)
"""What a `.fis` file does not state; chosen by `matlab_reader`."""


def converted(
    source: str, out: Path, *, tolerance: float | None, parameters: Sequence[str] = ()
) -> ConvertAnswer:
    """Write `out` in the format given by its file extension.

    Args:
        source: A shipped rulebook, a rulebook file or a `.fis` file.
        out: A `.fis` or YAML file, new or written by Comity.
        tolerance: Maximum error of a trapezoid that replaces a curve MATLAB does not have.
        parameters: Parameters to convert, with those their rules read; empty: all.

    Raises:
        InputError: Something cannot be read, expressed or written; nothing is written then.
    """
    to_matlab = is_fis(out)
    if not to_matlab and (out.suffix.lower() not in {".yaml", ".yml"} or not is_fis(source)):
        raise InputError(
            expected="a .fis file, or a .yaml file from a .fis file",
            got=repr(str(out)),
            remedy="Write for example `comity convert tipper.fis tipper.yaml`.",
            where=Where("OUT"),
        )
    refuse_foreign({out: (FIS_LINE if to_matlab else YAML_LINE).encode()})
    whole = load_rulebook(source)
    rulebook = _part(whole, parameters)
    answer, text = (
        _to_matlab(rulebook, source, out, tolerance) if to_matlab else _to_yaml(rulebook, source, out)
    )
    write_whole(out, text.encode())
    left = ", ".join(name for name in whole.parameters if name not in rulebook.parameters)
    return replace(answer, lost=(*answer.lost, f"not asked for: {left}")) if left else answer


def _part(rulebook: Rulebook, parameters: Sequence[str]) -> Rulebook:
    if not parameters:
        return rulebook
    try:
        return selected(rulebook, parameters)
    except InputError as error:
        raise error.at(Where("--parameter")) from None


def _to_matlab(
    rulebook: Rulebook, source: str, out: Path, tolerance: float | None
) -> tuple[ConvertAnswer, str]:
    try:
        exported = write_fis(rulebook, tolerance=tolerance)
    except InputError as error:
        raise error.at(Where(source)) from None
    back = parse_fis(exported.text, str(out))
    from_matlab = is_fis(source)
    answer = _answer(
        rulebook,
        back,
        source=source,
        file=str(out),
        changed=exported.changed,
        lost=("comments",) if from_matlab else exported.lost,
    )
    return answer, exported.text


def _to_yaml(rulebook: Rulebook, source: str, out: Path) -> tuple[ConvertAnswer, str]:
    text = rulebook_yaml(rulebook, Path(source).name)
    back = load_rulebook(parse_yaml(text, out, str(out)))
    answer = _answer(rulebook, back, source=source, file=str(out), changed=CHOSEN, lost=("comments",))
    return answer, text


def _empty_terms(rulebook: Rulebook) -> Iterator[str]:
    """Output terms that have no effect."""
    for name, parameter in rulebook.parameters.items():
        if isinstance(parameter, NumericParameter):
            nothing = f"0 everywhere in {parameter.rules}; rules that conclude it change nothing"
            yield from (f"{name} is {term}: {nothing}" for term in parameter.empty_terms)


def _answer(
    rulebook: Rulebook,
    back: Rulebook,
    *,
    source: str,
    file: str,
    changed: tuple[str, ...],
    lost: tuple[str, ...],
) -> ConvertAnswer:
    comparison = compare(rulebook, back)
    return ConvertAnswer(
        source=source,
        file=file,
        rulebook=rulebook.name,
        variables=len(rulebook.variables),
        parameters=len(rulebook.parameters),
        rules=len(back.rules),
        changed=(*changed, *_empty_terms(rulebook)),
        lost=lost,
        inputs_tried=comparison.inputs,
        largest_differences=comparison.differences,
    )
