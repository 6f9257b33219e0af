"""`python -m tests.bench`: measure speed, as ratios."""

from __future__ import annotations

import argparse
import importlib
import json
import platform
import sys
from pathlib import Path

from tests.bench.contest import Bench
from tests.bench.rows import Row, table

SUITES = ("inference", "explaining", "planning", "ticking", "commands", "episode", "page", "world")


def main() -> None:
    """Run the suites, print the table, write the JSON."""
    options = _options()
    bench = Bench(quick=options.quick, ours_only=options.ours_only)
    rows: list[Row] = []
    for name in options.suite or SUITES:
        print(f"suite {name}", file=sys.stderr)
        rows += importlib.import_module(f"tests.bench.suites.{name}").run(bench)
    print(table(rows))
    if options.out:
        machine = {
            "python": platform.python_version(),
            "system": platform.system(),
            "machine": platform.machine(),
        }
        content = {"quick": options.quick, "machine": machine, "rows": [row.as_json() for row in rows]}
        options.out.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument("--suite", action="append", choices=SUITES, help="only this one; may be repeated")
    parser.add_argument("--quick", action="store_true", help="one short round of small sizes")
    parser.add_argument("--ours-only", action="store_true", help="leave the competitors out")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write everything as JSON")
    return parser.parse_args()


if __name__ == "__main__":
    main()
