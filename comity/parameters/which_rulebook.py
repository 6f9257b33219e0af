"""Which rulebook decides: one a run, and why that one.

The paper's own rules rest on contested evidence: for the same culture they keep most men farther away than
women. They are what the paper is about, so an example goes by them. As soon as a stored profile or a real
robot takes part, only what studies support decides.
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
"""The rules of Bruno et al. (2017), and what the acts need besides."""
EVIDENCE = "evidence"
"""Only what studies support to a moderate degree at least."""


@dataclass(frozen=True, slots=True)
class ChosenRulebook:
    """The one rulebook of a run."""

    file: YamlFile
    where: Where
    """Where it is named: the scenario's line, or the command line."""
    why: str
    """Why it is this one."""


@dataclass(frozen=True, slots=True)
class Which:
    """A shipped rulebook, and why it is that one."""

    name: str
    why: str


def which_rulebook(people: Iterable[Declared], *, real_robot: bool = False) -> Which:
    """The rulebook where neither the command nor the scenario names one.

    Args:
        people: Everybody who takes part.
        real_robot: Whether a real robot carries it out.
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
    """The rulebook that was asked for, else the scenario's, else the right one for those who take part.

    Args:
        file: The scenario.
        declared: Everybody's profile, by person.
        asked: A shipped name or a file that goes before the scenario's.

    Raises:
        InputError: if there is none, or it is no YAML.
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
