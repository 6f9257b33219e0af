"""Digest of the installed code: other code may compute other results."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib.util import find_spec
from pathlib import Path

PACKAGES = ("comity", "comity_domain", "comity_executor", "comity_fis", "comity_sim2d")
NO_CODE = ("profiles", "scenarios", "rulebooks")
"""Folders whose files count only where a result depends on one of them."""
SUFFIXES = (".py", ".yaml", ".pddl", ".csv")


@cache
def installed_code() -> str:
    """SHA-256 of all files of the five packages that an episode may depend on."""
    digest = hashlib.sha256()
    for package in PACKAGES:
        spec = find_spec(package)
        assert spec is not None
        assert spec.origin is not None
        root = Path(spec.origin).parent
        for path in sorted(root.rglob("*")):
            if path.suffix in SUFFIXES and path.relative_to(root).parts[0] not in NO_CODE:
                digest.update(path.read_bytes())
    return digest.hexdigest()
