"""Standard output and standard error of every kind: few characters, no room, closed."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

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
