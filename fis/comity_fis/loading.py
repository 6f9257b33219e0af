"""Rulebooks by name or path; what reads and checks them is imported only when one is loaded."""

from __future__ import annotations

from functools import cache
from importlib.resources import as_file, files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity_fis.errors import InputError, closest, shown, unknown_word

if TYPE_CHECKING:
    from comity_fis.matlab.writer import Exported
    from comity_fis.rulebook.rulebook import Rulebook
    from comity_fis.validation.yaml_file import YamlFile


@cache
def shipped_rulebooks() -> tuple[str, ...]:
    """The names of the rulebooks that come with the package."""
    names = (entry.name for entry in files("comity_fis").joinpath("rulebooks").iterdir())
    return tuple(sorted(name.removesuffix(".yaml") for name in names if name.endswith(".yaml")))


def is_fis(path: str | Path) -> bool:
    """Whether a path names a file of MATLAB, `.fis` or `.FIS`."""
    return Path(path).suffix.lower() == ".fis"


def load_rulebook(source: str | Path | YamlFile) -> Rulebook:
    """A rulebook by its shipped name, from a YAML file or a `.fis` file of MATLAB, or a part of another file.

    Raises:
        InputError: with file and line, if there is no such rulebook or something in it cannot be used.
    """
    from comity_fis.rulebook.reader import rulebook_from
    from comity_fis.validation.yaml_file import YamlFile

    return rulebook_from(source if isinstance(source, YamlFile) else read_rulebook(source))


def read_rulebook(name_or_path: str | Path) -> YamlFile:
    """The file behind a shipped rulebook's name or a path, read and not yet checked; a `.fis` file as YAML.

    Raises:
        InputError: if there is no such rulebook, or it is no YAML.
    """
    from comity_fis.validation.yaml_file import read_yaml

    if not isinstance(name_or_path, str | Path):
        raise InputError(
            expected="a rulebook by name or path",
            got=shown(name_or_path),
            remedy=f"{closest('', shipped_rulebooks())} Or name a file.",
        )
    if name_or_path in shipped_rulebooks():
        with as_file(files("comity_fis").joinpath("rulebooks", f"{name_or_path}.yaml")) as path:
            return read_yaml(path, f"{name_or_path}.yaml")
    path = Path(name_or_path)
    if is_fis(path):
        return _from_matlab(path)
    if path.suffix.lower() not in {".yaml", ".yml"} and not path.exists():
        raise unknown_word(
            "a shipped rulebook, a YAML file or a .fis file", str(name_or_path), shipped_rulebooks()
        )
    return read_yaml(path)


def _from_matlab(path: Path) -> YamlFile:
    from comity_fis.matlab.reader import read_fis
    from comity_fis.rulebook.writer import rulebook_yaml
    from comity_fis.validation.yaml_file import parse_yaml

    return parse_yaml(rulebook_yaml(read_fis(path), path.name), path, str(path))


def to_fis(rulebook: Rulebook, *, tolerance: float | None = None) -> Exported:
    """A rulebook as a `.fis` file of MATLAB, with what is there in another form, and what is not there.

    Args:
        rulebook: With numeric parameters, and rules that read variables only.
        tolerance: The largest error of a trapezoid that stands for a curve MATLAB does not have; None
            refuses such curves.

    Raises:
        InputError: for whatever changes an answer and has no counterpart.
    """
    from comity_fis.matlab.writer import write_fis

    return write_fis(rulebook, tolerance=tolerance)


def rulebook_schema() -> dict[str, Any]:
    """The JSON schema of a rulebook file."""
    from comity_fis.rulebook.models import RulebookModel

    return RulebookModel.model_json_schema()
