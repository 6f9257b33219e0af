"""Environments of the competitors: made when first needed, kept under `.venv-bench/`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).parents[2] / ".venv-bench"

REQUIREMENTS = {
    "skfuzzy": ("scikit-fuzzy==0.5.0", "numpy", "scipy", "networkx", "packaging", "matplotlib"),
    "simpful": ("simpful==2.12.0",),
    "pyfuzzylite": ("pyfuzzylite==8.0.6",),
    "ir-sim": ("ir-sim==2.12.0",),
    "pysocialforce": ("pysocialforce==1.1.2",),
    "jupedsim": ("jupedsim==1.4.2",),
    "symk": ("up-symk==1.6.0",),
}
"""What goes into each."""


class NotInstalledError(Exception):
    """A competitor cannot be had here; the message says why."""


def interpreter(name: str | None) -> Path:
    """The Python that has a competitor; this one for None.

    Raises:
        NotInstalledError: if its environment cannot be made.
    """
    if name is None:
        return Path(sys.executable)
    folder = FOLDER / name
    python = folder / "bin" / "python"
    if not (folder / ".ready").exists():
        print(f"making the environment of {name} in {folder}", file=sys.stderr)
        _run([sys.executable, "-m", "venv", "--clear", str(folder)])
        _run(
            [
                str(python),
                "-m",
                "pip",
                "install",
                "--quiet",
                "--disable-pip-version-check",
                *REQUIREMENTS[name],
            ]
        )
        (folder / ".ready").touch()
    return python


def _run(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        last = (done.stderr or done.stdout).strip().splitlines()[-1:]
        raise NotInstalledError(f"could not be installed: {''.join(last)[:150]}")
