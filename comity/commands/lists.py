"""`comity profiles | rulebooks | scenarios | maps`: what ships with Comity."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from comity_fis import Rulebook


def profiles(as_json: AsJson = False) -> None:
    """List the shipped profiles, and those that are kept on this machine."""
    from comity.people.profile import load_profile
    from comity.people.store import Store
    from comity.system.library import shipped
    from comity_fis import InputError

    kept = [name for name in Store().names if Store().path(name)]
    about = {name: load_profile(name).profile.about for name in shipped("profile")}
    for name in kept:
        try:
            about[name] = load_profile(name).profile.about
        except InputError as error:  # nobody else's list depends on one damaged file
            about[name] = f"It cannot be read: {error}"
    marked = {name: f"Kept here. {text}" if name in kept else text for name, text in about.items()}
    _show("profiles", marked, as_json)


def rulebooks(as_json: AsJson = False) -> None:
    """List the shipped rulebooks, with how many of their rules are on."""
    from collections import Counter

    from comity_fis import load_rulebook, shipped_rulebooks

    books = [load_rulebook(name) for name in shipped_rulebooks()]
    about = {book.name: f"{book.description} {_rules(book)}" for book in books}
    counts: dict[str, dict[str, object]] = {
        book.name: {
            "rules": len(book.rules),
            "off": sum(not rule.enabled for rule in book.rules),
            "evidence": dict(Counter(rule.evidence for rule in book.rules)),
        }
        for book in books
    }
    _show("rulebooks", about, as_json, counts)


def _rules(book: Rulebook) -> str:
    off = sum(not rule.enabled for rule in book.rules)
    return f"({len(book.rules)} rules{f', {off} of them off' if off else ''})"


def scenarios(
    name: Annotated[
        str | None, typer.Option("--set", metavar="NAME", help="Those of a set: comity-bench-1.")
    ] = None,
    *,
    as_json: AsJson = False,
) -> None:
    """List the shipped scenarios by theme, or those of a named set."""
    from comity.system.scenario_sets import SETS, by_theme, set_asked, set_named

    if name:
        _show("scenarios", _about(set_asked(name)), as_json)
        return
    themes = {theme: _about(files) for theme, files in by_theme().items()}
    if as_json:
        rows = [
            {"name": each, "about": text, "theme": theme}
            for theme, about in themes.items()
            for each, text in about.items()
        ]
        print_json({"scenarios": rows})
        return
    from comity.report.text import show, table

    for theme, about in themes.items():
        show(theme.capitalize(), table(about.items()), "")
    for each in SETS:
        show(f"{len(set_named(each))} more are in the benchmark: comity scenarios --set {each}")


def _about(files: Mapping[str, Path]) -> dict[str, str]:
    from comity.scenario import load_scenario

    return {name: load_scenario(name).scenario.about.strip() for name in files}


def maps(as_json: AsJson = False) -> None:
    """List the shipped maps, with their rooms, doors and named places."""
    from comity_sim2d import load_map, shipped_maps

    known = {name: load_map(name) for name in shipped_maps()}
    counts: dict[str, dict[str, object]] = {
        name: {
            "rooms": [area.name for area in place.areas],
            "doors": {door.name: "open" if door.is_open else "closed" for door in place.doors},
            "locations": [location.name for location in place.locations],
        }
        for name, place in known.items()
    }
    _show("maps", {name: place.about for name, place in known.items()}, as_json, counts)


def _show(
    kind: str, about: dict[str, str], as_json: bool, more: Mapping[str, Mapping[str, object]] | None = None
) -> None:
    if as_json:
        rows = [
            {"name": name, "about": text.strip(), **(more or {}).get(name, {})}
            for name, text in about.items()
        ]
        print_json({kind: rows})
        return
    from comity.report.text import show, table

    show(table([(name, text.strip()) for name, text in about.items()]))
