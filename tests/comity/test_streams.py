"""Standard output and standard error of every kind: few characters, no room, closed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

FULL = Path("/dev/full")
on_full = pytest.mark.skipif(not FULL.exists(), reason="the system has no device that is always full")
CONSENT = ("explain", "greeting_gesture", "german_host", "--set", "touch_consent=unknown")


@pytest.fixture
def program(here):
    """The command line as a program of its own: `program("profiles", stdout=file, encoding="ascii")`."""

    def run(*words: str, encoding: str = "utf-8", **streams: object) -> subprocess.CompletedProcess[bytes]:
        kinds = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | streams
        environment = os.environ | {"PYTHONIOENCODING": encoding}
        return subprocess.run(
            [sys.executable, "-m", "comity", *words], cwd=here, env=environment, check=False, **kinds
        )

    return run


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "ascii:surrogateescape"])
def test_what_the_output_cannot_write_has_a_stand_in(encoding, program):
    done = program(*CONSENT, encoding=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    assert b"touch consent not disclosed -> given" in done.stdout


@pytest.mark.parametrize(("encoding", "said"), [("ascii", b"'Jorg ->'"), ("cp1252", b"'J\xf6rg ->'")])
def test_what_standard_error_cannot_write_has_a_stand_in(encoding, said, program):
    done = program("infer", "Jörg →", encoding=encoding)
    assert done.returncode == 2
    assert said in done.stderr


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "utf-8"])
def test_json_says_the_same_whatever_the_output_can_write(encoding, program, here):
    (here / "Jörg →.scenario.yaml").write_text("name: none\n", encoding="utf-8")
    done = program("test", "--json", encoding=encoding)
    (told,) = json.loads(done.stdout.decode(encoding))["tests"]
    assert told["file"] == "Jörg →.scenario.yaml"
    assert ("\\u2192" in done.stdout.decode(encoding)) == (encoding != "utf-8")


def test_a_closed_standard_output_swallows_what_is_said(here):
    closing = 'exec "$@" >&-'
    done = subprocess.run(
        ["sh", "-c", closing, "sh", sys.executable, "-m", "comity", *CONSENT],
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


@on_full
@pytest.mark.parametrize(
    "words",
    [("profiles",), ("scenarios", "--json"), ("schema", "scenario"), CONSENT, ("--version",), ("--help",)],
)
def test_a_full_output_is_told_in_one_line(words, program):
    """Of whatever length it is: little is only written at the end, much is at once."""
    with FULL.open("wb") as full:
        done = program(*words, stdout=full)
    assert done.returncode == 2
    assert done.stderr.decode() == (
        "comity: the output could not be written: expected room for it, got No space left on device. "
        "Make room, or have it written elsewhere.\n"
    )


@on_full
def test_a_full_standard_error_changes_no_exit_code(program):
    with FULL.open("wb") as full:
        assert program("infer", "nobody", stderr=full).returncode == 2


def test_who_has_seen_enough_of_the_output_ends_it_without_a_word(program):
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "wb") as pipe:
        done = program("profiles", stdout=pipe)
    assert (done.returncode, done.stderr) == (0, b"")
