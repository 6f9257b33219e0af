"""Ctrl-C and SIGTERM end the program in one line, whenever they come; with 130 and 143, as shells have it."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from terminal import signals_of_a_terminal

import comity

OURS = Path(comity.__file__).parent
STOPPED = "comity: interrupted\n"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("imported", ["comity.cli", "typer", "comity_fis.errors", "numpy", "shapely"])
def test_it_is_stopped_while_it_imports(imported, number, here):
    """At the very moment at which it begins to."""
    code = (
        "import os, runpy, sys\n"
        f"stop = lambda event, of: of[0] == {imported!r} and os.kill(os.getpid(), {number:d})\n"
        "sys.addaudithook(lambda event, of: event == 'import' and stop(event, of))\n"
        "sys.argv = ['comity', 'run']; runpy.run_module('comity', run_name='__main__')"
    )
    with signals_of_a_terminal():
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=here, capture_output=True, text=True, check=False
        )
    assert (done.returncode, done.stdout, done.stderr) == (128 + number, "", STOPPED)
    assert not list(here.iterdir())


@pytest.mark.parametrize(
    ("imported", "words"), [("typer", ["run"]), ("comity.testing.grammar.sentence", ["test", "--json"])]
)
def test_it_is_stopped_while_a_class_is_made(imported, words, here):
    """Python 3.11 tells of that with an error of its own, which is none of ours; what is due is printed."""
    code = (
        "import runpy, signal, sys\n"
        "class Attribute:\n"
        "    def __set_name__(self, owner, name): signal.raise_signal(signal.SIGINT)\n"
        f"once = [{imported!r}]\n"
        "def made(event, of):\n"
        "    if of[0] in once:\n"
        "        once.clear()\n"
        "        type('A', (), {'a': Attribute()})\n"
        "sys.addaudithook(lambda event, of: event == 'import' and made(event, of))\n"
        f"sys.argv = {['comity', *words]!r}; runpy.run_module('comity', run_name='__main__')"
    )
    with signals_of_a_terminal():
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=here, capture_output=True, text=True, check=False
        )
    assert (done.returncode, done.stderr) == (130, STOPPED)
    assert bool(done.stdout) == ("--json" in words)
    assert json.loads(done.stdout or "{}").get("tests", []) == []


@pytest.mark.parametrize("after_s", [0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5])
def test_no_traceback_names_our_files_however_early_ctrl_c_comes(after_s, here):
    """Before our first line it is Python's own, which may say so in its own way."""
    command = [sys.executable, "-m", "comity", "test", "--shipped", "--json"]  # takes long enough
    with signals_of_a_terminal():
        process = subprocess.Popen(
            command, cwd=here, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
    time.sleep(after_s)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert str(OURS) not in said
    assert (process.returncode, said) == (130, STOPPED) or process.returncode in (1, -signal.SIGINT)


def test_what_whoever_starts_it_has_it_ignore_stays_ignored(here):
    """As a shell does with Ctrl-C for what runs in its background."""
    code = (
        "import runpy, signal, sys; signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
        "sys.addaudithook(lambda event, of: event == 'import' and of[0] == 'typer'"
        " and signal.raise_signal(signal.SIGINT))\n"
        "sys.argv = ['comity', 'profiles']; runpy.run_module('comity', run_name='__main__')"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=here, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "german_woman" in done.stdout
