"""Studies and populations as tests write them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from comity_fis.validation.yaml_file import dump_yaml

COMFORT = {"middle_m": 0.8, "sd_m": 0.25, "source": "design choice"}


def study(path: Path, **keys: Any) -> Path:
    """A study's file with these keys beside what every study has."""
    content = {"schema_version": 1, "name": path.name.split(".")[0], "scenarios": ["johanna"], **keys}
    path.write_text(dump_yaml({key: part for key, part in content.items() if part is not None}), "utf-8")
    return path


def population(path: Path, *, groups: dict[str, Any] | None = None, **keys: Any) -> Path:
    """A population's file: two groups of two, unless it has others."""
    women = {"individuals": 2, "facts": {"culture": "SWE", "gender": "female"}, "comfort": COMFORT}
    men = {"individuals": 2, "facts": {"culture": "Arab countries", "gender": "male"}, "comfort": COMFORT}
    drawn = {"swedish_women": women, "arab_men": men} if groups is None else groups
    content = {"schema_version": 1, "name": "people", **({"groups": drawn} if drawn else {}), **keys}
    path.write_text(dump_yaml(content), "utf-8")
    return path
