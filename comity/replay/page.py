"""The page: markup, style, script and data in one HTML file, without network requests."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from comity.replay.episode_data import episode_data
from comity.replay.inlining import joined
from comity.replay.parting import parting

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from comity.output.run_folder import RunFolder

MARK = b'<meta name="generator" content="Comity replay">'
"""Marker near the start of every page: such a file may be replaced by another page."""

STYLES = ("colours", "page", "plan", "transport", "world", "tree", "why", "screens")
"""Parts of the style sheet, in order: later rules override earlier ones."""


def replay_page(folder: RunFolder, other: RunFolder | None = None) -> str:
    """The HTML of a run, or of two runs side by side.

    Args:
        folder: The run.
        other: A second run to compare with; None for one run.

    Raises:
        InputError: if a file of a run is missing or damaged.
    """
    folders = [one for one in (folder, other) if one is not None]
    runs = [{**episode_data(one), "name": name} for one, name in zip(folders, _names(folders), strict=True)]
    data = {"runs": runs, "parting": parting(folder, other) if other is not None else []}
    return page_of(data)


def _names(folders: Sequence[RunFolder]) -> list[str]:
    """Names of the runs: their folders, or the parent folders if those have the same name."""
    paths = [folder.path.resolve() for folder in folders]
    names = [path.name for path in paths]
    if len(set(names)) == len(names):
        return names
    if len(set(paths)) == 1:
        return [names[0], f"{names[0]} (the same folder)"]
    longer = [f"{path.parent.name}/{path.name}" for path in paths]
    return longer if len(set(longer)) == len(longer) else [str(path) for path in paths]


def page_of(data: Mapping[str, object]) -> str:
    """The page with embedded data; deterministic."""
    before, after = _shell()
    return f"{before}{inline_json(data)}{after}"


def inline_json(data: object) -> str:
    """JSON that can be embedded in a script element: it cannot end the element, or a line of the script."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for sign in "<>&\u2028\u2029":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return text


@cache
def _shell() -> tuple[str, str]:
    """The parts of the page before and after the data."""
    sources = {
        path.name: path.read_text(encoding="utf-8")
        for path in files("comity.replay").joinpath("web").iterdir()
    }
    modules = {name.removesuffix(".js"): text for name, text in sources.items() if name.endswith(".js")}
    style = "\n".join(sources[f"{name}.css"] for name in STYLES)
    page = sources["page.html"].replace("/* STYLE */", style)
    page = page.replace("/* SCRIPT */", joined(modules, "page"))
    before, after = page.split("/* DATA */")
    return before, after
