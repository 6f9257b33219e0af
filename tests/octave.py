"""GNU Octave's fuzzy toolkit as a judge; run this file to make its stored answers again.

    python tests/octave.py

Its rules are not MATLAB's everywhere: areas are by the trapezoid rule, the bisector is an index, som and
lom are not by magnitude, `probor` is `algebraic_sum`. The comparison goes by its rules (`test_octave`).
"""

from __future__ import annotations

import json
import shutil
import subprocess
import tempfile
from pathlib import Path

DATA = Path(__file__).parent / "fis" / "data"
ANSWERS = DATA / "octave_answers.json"
POINTS = 101

METHODS = [
    ("min", "max", "min", "max", "centroid"),
    ("prod", "probor", "prod", "max", "centroid"),
    ("min", "max", "prod", "sum", "centroid"),
    ("prod", "max", "min", "probor", "centroid"),
    ("min", "probor", "min", "sum", "centroid"),
    ("prod", "probor", "prod", "probor", "centroid"),
    ("min", "max", "min", "max", "bisector"),
    ("prod", "probor", "prod", "sum", "bisector"),
    ("min", "max", "min", "max", "mom"),
    ("min", "max", "min", "max", "som"),
    ("min", "max", "min", "max", "lom"),
    ("prod", "probor", "prod", "sum", "mom"),
    ("min", "max", "prod", "probor", "lom"),
]
KEYS = ("AndMethod", "OrMethod", "ImpMethod", "AggMethod", "DefuzzMethod")
INPUTS = {
    "tipping": [
        (0, 0),
        (1.3, 9.7),
        (2.5, 2),
        (3.1, 7.9),
        (5, 5),
        (6.2, 0.4),
        (7.7, 8.3),
        (10, 10),
        (9.1, 2.2),
    ],
    "curves": [
        (-10, 0),
        (-7.3, 0.9),
        (-3.1, 0.35),
        (-0.4, 0.62),
        (0.5, 0.5),
        (2.9, 0.11),
        (4.4, 0.77),
        (8, 1),
    ],
}


def variants() -> dict[str, tuple[str, str]]:
    """Every system under every choice of methods: its text, and the name of its inputs."""
    found = {}
    for base in INPUTS:
        text = (DATA / f"{base}.fis").read_text()
        for methods in METHODS:
            changed = text
            for key, default, method in zip(KEYS, METHODS[0], methods, strict=True):
                changed = changed.replace(f"{key}='{default}'", f"{key}='{method}'")
            found["-".join((base, *methods))] = changed, base
    return found


def ask() -> dict[str, list[list[float]]]:
    """Octave's outputs for all variants and inputs, with 101 points; nothing where it is not installed."""
    if shutil.which("octave-cli") is None:
        return {}
    with tempfile.TemporaryDirectory() as folder:
        lines = [
            "1;",
            "pkg load fuzzy-logic-toolkit;",
            "function y = probor (varargin) y = algebraic_sum (varargin{:}); endfunction",
        ]
        for name, (text, base) in variants().items():
            file = Path(folder) / f"{name}.fis"
            file.write_text(text)
            rows = "; ".join(" ".join(map(repr, row)) for row in INPUTS[base])
            lines.append(f"out = evalfis ([{rows}], readfis ('{file}'), {POINTS});")
            lines.append(f"printf ('{name} %s\\n', sprintf ('%.17g ', out'));")
        script = Path(folder) / "ask.m"
        script.write_text("\n".join(lines))
        printed = _octave(f"source ('{script}')")
    answers = {}
    for line in printed.splitlines():
        name, *numbers = line.split()
        if name in variants():
            values = [float(number) for number in numbers]
            answers[name] = [values[i : i + 2] for i in range(0, len(values), 2)]
    return answers


def version() -> str:
    """What answered."""
    toolkit = "p = pkg ('list', 'fuzzy-logic-toolkit'){1};"
    say = "printf ('GNU Octave %s, fuzzy-logic-toolkit %s', OCTAVE_VERSION, p.version)"
    return _octave(f"pkg load fuzzy-logic-toolkit; {toolkit} {say}").strip()


def _octave(command: str) -> str:
    run = subprocess.run(
        ["octave-cli", "--no-init-file", "--quiet", "--eval", command],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    return run.stdout


if __name__ == "__main__":
    stored = {"origin": version(), "command": "python tests/octave.py", "answers": ask()}
    ANSWERS.write_text(json.dumps(stored).replace(' "', '\n "').replace(", [", ",\n  [") + "\n")
