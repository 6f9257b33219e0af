"""`make oracle`: do the scenarios plan and do what they did, for each of the four profiles of the paper?"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from comity.episode import fingerprint
from tests.oracle.comparing import Comparison
from tests.oracle.line import Line
from tests.oracle.playing import play

KEPT = Path(__file__).parent / "lines.jsonl"


def main() -> int:
    """Play and compare; exit code 1 where behaviour changed and the new lines are not to be kept."""
    options = argparse.ArgumentParser(prog="python -m tests.oracle", description=__doc__)
    options.add_argument("--only", default="", metavar="WORD", help="only scenarios whose names contain it")
    options.add_argument("--keep", action="store_true", help="write what was played to lines.jsonl")
    asked = options.parse_args()
    head, kept = _kept()
    same_fingerprint = head.get("fingerprint") == fingerprint()
    counts: Counter[str] = Counter()
    for line in play(asked.only):
        one = Comparison(kept.get(line["case"]), line, same_fingerprint)
        counts[one.kind] += 1
        if one.kind in ("other plan", "other outcome"):
            print(one.text, flush=True)
        kept[line["case"]] = line
    print(*(f"{count:5} {kind}" for kind, count in counts.most_common()), sep="\n")
    if not same_fingerprint:
        print(
            f"      digests were not compared: kept on {head.get('fingerprint')}, played on {fingerprint()}"
        )
    if not counts:
        options.error(f"--only: expected a word of a scenario's name, no name contains {asked.only!r}")
    if asked.keep:
        _keep(kept.values())
    return 0 if asked.keep or not counts["other plan"] + counts["other outcome"] else 1


def _kept() -> tuple[Line, dict[str, Line]]:
    if not KEPT.exists():
        return {}, {}
    try:
        head, *lines = [json.loads(line) for line in KEPT.read_text("utf-8").splitlines()]
        return head, {line["case"]: line for line in lines}
    except (ValueError, KeyError, TypeError) as error:
        raise SystemExit(
            f"{KEPT}: expected a line of JSON per case, got {error}; take it from the repository again"
        ) from None


def _keep(lines: Iterable[Line]) -> None:
    rows = [{"fingerprint": fingerprint()}, *sorted(lines, key=lambda line: str(line["case"]))]
    text = "".join(json.dumps(row, ensure_ascii=False) + "\n" for row in rows)
    KEPT.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    sys.exit(main())
