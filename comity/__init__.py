"""Comity makes social robots culture-aware: `comity.run("johanna")` plans an episode and executes it."""

from __future__ import annotations

TYPE_CHECKING = False  # as in `typing`, whose import would come before Ctrl-C can be caught
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from datetime import date
    from pathlib import Path
    from typing import Any

    from comity.adaptation.stored_profile import StoredProfile
    from comity.episode import Episode
    from comity.people.profile import ProfileGiven
    from comity_domain import PlanningFailed
    from comity_executor import MakeAct, MapRobot
    from comity_fis import ComityError, Inference, InputError

    __version__: str

__all__ = ["ComityError", "InputError", "PlanningFailed", "infer", "profile", "run"]

_LAZY = {
    "ComityError": "comity_fis.errors",
    "Episode": "comity.episode",
    "Inference": "comity_fis",
    "InputError": "comity_fis.errors",
    "ParameterValue": "comity_fis",
    "Plan": "comity_domain",
    "PlanningFailed": "comity_domain.errors",
    "Rulebook": "comity_fis",
    "SceneError": "comity_sim2d",
    "StoredProfile": "comity.adaptation.stored_profile",
}
"""What the functions here return and raise, by name, with the module that is loaded when it is asked for."""


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("comity")
    if name in _LAZY:
        from importlib import import_module

        return getattr(import_module(_LAZY[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, *_LAZY, "__version__"})


def run(
    scenario: str | Path,
    *,
    profiles: Mapping[str, ProfileGiven] | None = None,
    rulebook: str | None = None,
    at: date | str | None = None,
    seed: int = 0,
    out: str | Path | None = None,
    acts: Mapping[str, MakeAct] | None = None,
    robot: MapRobot | None = None,
    adults_only: bool = False,
    reduced_margin: bool = False,
    unreviewed_wordings: bool = False,
    site_language: str | None = None,
    wordings: Sequence[str | Path] = (),
) -> Episode:
    """Run one episode.

    Args:
        scenario: A shipped scenario's name or a file.
        profiles: Other profiles than the scenario's, by person: shipped or stored names, files, or profiles
            written out, as in `{"guest": {"culture": "SWE", "age": 70}}`.
        rulebook: A rulebook instead of the scenario's: a shipped name or a file.
        at: The day on which dated facts are taken; else the scenario's, else today where some fact needs it.
        seed: Seed of random places and sensor noise.
        out: Folder for the run's files; None writes nothing.
        acts: Custom behaviours in place of the robot's acts, by the act's name: `say`, or a gesture of the
            rulebook. Each is a class or function of its node's name and the person.
        robot: A real robot in place of the simulated one, on the scenario's map; its position and the people
            are what it senses (`comity_executor.MapRobot` is the protocol).
        adults_only: `True` asserts that every person of unknown age is 18 or older; a real robot visits only
            adults.
        reduced_margin: The operator's permission for a real robot to pass people at the scenario's
            `margin_m`.
        unreviewed_wordings: Let a real robot say wordings that no speaker of the language has reviewed. Else
            the robot says the name and a plain greeting in the language of the site.
        site_language: The language of the place, by code or name, instead of the scenario's.
        wordings: Files of wordings, before those that ship.

    Returns:
        The episode: outcome, visits, trace, frames and metrics.

    Raises:
        InputError: If an argument is invalid.
        SceneError: If the scenario's scene is, such as two people in one place; also an `InputError`.
        PlanningFailed: If the planner finds no plan.
    """
    from dataclasses import replace

    from comity.live.loading import require_map_robot
    from comity.live.start import as_seen, for_adults, with_reduced_margin
    from comity.live_episode import execute
    from comity.parameters.speaking import at_site
    from comity.preparation import prepare, require_seed
    from comity.scenario import load_scenario

    require_seed(seed)
    if not isinstance(adults_only, bool):
        from comity_fis import InputError

        raise InputError(
            expected="True or False for adults_only",
            got=repr(adults_only),
            remedy="State True only if every person of unknown age is 18 or older.",
        )
    file = load_scenario(str(scenario))
    if robot is not None:
        require_map_robot(robot, type(robot).__name__)
        file = for_adults(as_seen(file, robot), adults_only=adults_only)
        file = with_reduced_margin(file, allowed=reduced_margin is True)
    if site_language is not None or wordings:
        file = at_site(file, language=site_language, wordings=tuple(map(str, wordings)))
    prepared = prepare(file, profiles=profiles, rulebook=rulebook, at=_day(at), seed=seed)
    if out is None:
        episode = execute(
            prepared, seed=seed, acts=acts or {}, robot=robot, unreviewed_wordings=unreviewed_wordings
        )
        return replace(episode, page=_page_of)
    from pathlib import Path

    from comity.recording import record

    called = None if robot is None else type(robot).__name__
    recorded = record(
        prepared,
        seed=seed,
        out=Path(out),
        acts=acts or {},
        robot=robot,
        called=called,
        unreviewed_wordings=unreviewed_wordings,
    )
    return replace(recorded.episode, page=_page_of)


def infer(
    profile: ProfileGiven | None = None,
    *,
    rulebook: str | None = None,
    mode: Any = "exact",
    at: date | str | None = None,
    **facts: float | str | None,
) -> Inference:
    """One person's parameters.

    Args:
        profile: A shipped or stored profile's name, a file, or a profile written out, as in
            `{"culture": "SWE", "age": 70}`; None where nothing was disclosed.
        rulebook: A shipped name or a file; without it `evidence` for a stored profile, else `bruno2017`.
        mode: How the centre of area is computed: exact, matlab or skfuzzy.
        at: The day on which dated facts are taken; today without it, where some fact needs it.
        **facts: Values of the rulebook's variables; they go before the profile, None takes a fact back.

    Raises:
        InputError: If an argument is invalid.
    """
    from comity.parameters.acquaintance import learnt_here
    from comity.parameters.unread import noting_unread
    from comity.parameters.values import infer_for, refuse_unknown
    from comity.parameters.which_rulebook import which_rulebook
    from comity.people.profile import NOBODY, day_for, declared_by
    from comity_fis import load_rulebook

    person = NOBODY if profile is None else declared_by(profile, called="the person")
    book = load_rulebook(rulebook or which_rulebook([person]).name)
    refuse_unknown(facts, book, "the facts given")
    day = day_for(_day(at), person.profile)
    learnt = learnt_here(person, book, facts, day)
    inference = infer_for(person, book, situation=facts, mode=mode, at=day, learnt=learnt)
    return noting_unread(inference, book)


def profile(name: str, *, rulebook: str = "evidence") -> StoredProfile:
    """Stored person, to add observations to: `comity.profile("amal").observe("stepped_back", 0.8)`.

    Args:
        name: Of the stored profile.
        rulebook: It says what culture and situation alone give; a shipped name or a file.

    Raises:
        InputError: if there is no stored profile of that name.
    """
    from comity.adaptation.stored_profile import StoredProfile

    return StoredProfile(name, rulebook)


def _page_of(episode: Episode) -> str:
    from comity.recording import page_of

    return page_of(episode)


def _day(at: date | str | None) -> date | None:
    from comity.people.dated import day_given

    return day_given(at)
