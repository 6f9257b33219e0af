"""What a shell sees besides the commands themselves: completion of words, and the list of commands."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest


def completions(line: str) -> list[str]:
    """What Tab offers at the end of a line, by the protocol of bash."""
    asked = {
        "_COMITY_COMPLETE": "complete_bash",
        "COMP_WORDS": line,
        "COMP_CWORD": str(len(line.split()) - 1),
    }
    script = "import sys; sys.argv = ['comity']; from comity.__main__ import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, **asked},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout.split()


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("comity rep", ["replay"]),
        ("comity profile res", ["reset"]),
        ("comity replay --gi", ["--gif"]),
        ("comity run johan", ["johanna"]),
        ("comity plan two-v", ["two-visits"]),
        ("comity infer arab_w", ["arab_woman"]),
        ("comity run johanna --rulebook bruno2017-", ["bruno2017-case1", "bruno2017-case2"]),
    ],
)
def test_a_word_that_was_begun_is_completed(line, offered):
    assert completions(line) == offered


@pytest.mark.parametrize("words", [("--help",), ("profile", "--help")])
def test_a_wide_terminal_shows_the_summary_of_each_command_whole(words, comity, monkeypatch):
    monkeypatch.setenv("COLUMNS", "150")
    listed = comity(*words).out.partition("Commands:")[2]
    assert "..." not in listed
    assert all(line.rstrip().endswith(".") for line in listed.partition("\n\n")[0].strip().splitlines())
