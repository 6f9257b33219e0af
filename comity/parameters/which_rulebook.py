"""Selects the rulebook of a run, with the reason.

The paper's own rules rest on contested evidence: for the same culture they keep most men farther away than
women. As the paper is about them, examples use them. As soon as a stored profile or a real robot takes part,
only rules supported by studies are used.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comity.system.library import require_file
from comity_fis import InputError, Where, read_rulebook, shipped_rulebooks
from comity_fis.validation.name_or_path import looks_like_a_file

if TYPE_CHECKING:
    from comity.people.profile import Declared
    from comity.scenario import ScenarioFile
    from comity_fis.validation.yaml_file import YamlFile

PAPER = "bruno2017"
"""The rules of Bruno et al. (2017), and what the acts require in addition."""
EVIDENCE = "evidence"
"""Only rules with at least moderate support by studies."""


@dataclass(frozen=True, slots=True)
class ChosenRulebook:
    """The one rulebook of a run."""

    file: YamlFile
    where: Where
    """Location of its name: the scenario's line, or the command line."""
    why: str
    """The reason for it."""


@dataclass(frozen=True, slots=True)
class Which:
    """A shipped rulebook, and the reason for it."""

    name: str
    why: str


def which_rulebook(people: Iterable[Declared], *, real_robot: bool = False) -> Which:
    """The default rulebook, if neither the command nor the scenario names one.

    Args:
        people: Profiles of everybody who takes part.
        real_robot: Whether a real robot executes the plan.
    """
    if real_robot:
        return Which(EVIDENCE, "a real robot takes part")
    kept = next((declared.kept_as for declared in people if declared.kept_as), None)
    if kept is not None:
        return Which(EVIDENCE, f"the stored profile {kept} takes part")
    return Which(PAPER, "the paper's, as no stored profile and no real robot takes part")


def chosen_rulebook(
    file: ScenarioFile, declared: Mapping[str, Declared], asked: str | None = None
) -> ChosenRulebook:
    """The requested rulebook, else the scenario's, else the default one for the people.

    Args:
        file: The scenario.
        declared: All profiles, by person.
        asked: A shipped name or a file that overrides the scenario's.

    Raises:
        InputError: There is none, or it is not YAML.
    """
    written = file.scenario.rulebook
    if asked:
        where = Where("--rulebook")
        return ChosenRulebook(_read(asked, Path(asked), where), where, "asked for")
    if written is None:
        which = which_rulebook(declared.values(), real_robot=file.real_robot)
        return ChosenRulebook(read_rulebook(which.name), file.where("rulebook"), which.why)
    where = file.where("rulebook")
    own = (
        _read(written, file.folder / written, where)
        if isinstance(written, str)
        else file.file.part("rulebook")
    )
    return ChosenRulebook(own, where, "the scenario's")


def _read(written: str, path: Path, where: Where) -> YamlFile:
    if written not in shipped_rulebooks() and looks_like_a_file(written, path):
        require_file("rulebook", path, written, where)
        written = str(path)
    try:
        return read_rulebook(written)
    except InputError as error:
        raise error.at(where) from None
