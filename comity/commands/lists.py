"""`comity profiles | rulebooks | scenarios`: what ships with Comity."""

from __future__ import annotations

from comity.commands.options import AsJson, print_json


def profiles(as_json: AsJson = False) -> None:
    """List the shipped profiles, and those that are kept on this machine."""
    from comity.library import shipped
    from comity.profile import load_profile
    from comity.store import Store

    kept = [name for name in Store().names if Store().path(name)]
    about = {name: load_profile(name).profile.about for name in (*shipped("profile"), *kept)}
    marked = {name: f"Kept here. {text}" if name in kept else text for name, text in about.items()}
    _show("profiles", marked, as_json)


def rulebooks(as_json: AsJson = False) -> None:
    """List the shipped rulebooks."""
    from comity_fis import load_rulebook, shipped_rulebooks

    _show("rulebooks", {name: load_rulebook(name).description for name in shipped_rulebooks()}, as_json)


def scenarios(as_json: AsJson = False) -> None:
    """List the shipped scenarios."""
    from comity.library import shipped
    from comity.scenario import load_scenario

    _show("scenarios", {name: load_scenario(name).scenario.about for name in shipped("scenario")}, as_json)


def _show(kind: str, about: dict[str, str], as_json: bool) -> None:
    if as_json:
        print_json({kind: [{"name": name, "about": text.strip()} for name, text in about.items()]})
        return
    from comity.report.text import show, table

    show(table([(name, text.strip()) for name, text in about.items()]))
