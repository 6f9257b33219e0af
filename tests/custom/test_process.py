"""One process for a request: its answer comes back, its end comes in time, and nothing is left of it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from functools import partial
from pathlib import Path

import pytest

from comity_domain import PlanningFailed
from comity_domain.custom import process
from comity_domain.custom.process import in_one_process
from comity_fis import InputError, Where

REFUSAL = InputError(expected="tea", got="'coffee'", remedy="Write tea.", where=Where("file", 3, 4))
FAILURE = PlanningFailed("no plan", remedy="Ask for less.", cut_off=True)


def raised(error: Exception) -> None:
    """Raise it."""
    raise error


def ended(code: int) -> None:
    """End the process."""
    os._exit(code)


def held() -> None:
    """Never end."""
    while True:
        time.sleep(1)


def held_by_an_engine(report: Path) -> None:
    """Start an engine in a session of its own, as unified-planning does, that starts another; wait for it."""
    waits = "import time; time.sleep(60)"
    script = f"import subprocess, sys; subprocess.Popen([sys.executable, '-c', {waits!r}]); {waits}"
    engine = subprocess.Popen([sys.executable, "-c", script], start_new_session=True)
    report.write_text(f"{engine.pid} {os.getpid()} {tempfile.gettempdir()}")
    engine.wait()


def eaten() -> bytes:
    """Take more memory than there may be."""
    return b"x" * 3_000_000_000


def in_session(leader: int) -> list[int]:
    """The processes of a session."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            state, _, _, session = (entry / "stat").read_text().rpartition(")")[2].split()[:4]
        except OSError:
            continue
        if int(session) == leader and state != "Z":
            found.append(int(entry.name))
    return found


def is_gone(report: Path) -> bool:
    """Whether the sessions and the folder that a report names have ended."""
    engine, child, folder = report.read_text().split()
    for _ in range(100):
        if not in_session(int(engine)) and not in_session(int(child)) and not Path(folder).exists():
            return True
        time.sleep(0.05)
    return False


needs_proc = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks processes up in /proc")


def test_what_a_call_returns_comes_back():
    assert in_one_process(partial(divmod, 17, 5), limit_s=30.0) == (3, 2)


def test_it_works_in_any_thread():
    found = []
    thread = threading.Thread(target=lambda: found.append(in_one_process(partial(abs, -3), limit_s=30.0)))
    thread.start()
    thread.join()
    assert found == [3]


@pytest.mark.parametrize("error", [REFUSAL, FAILURE], ids=["bad input", "no plan"])
def test_a_refusal_keeps_its_parts(error):
    with pytest.raises(type(error)) as refusal:
        in_one_process(partial(raised, error), limit_s=30.0)
    assert vars(refusal.value) == vars(error)
    assert str(refusal.value) == str(error)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            partial(raised, ValueError("odd")),
            r"planning broke off \(ValueError: odd, in raised of test_process",
        ),
        (partial(raised, ZeroDivisionError()), "something is divided by 0"),
        (eaten, "within 2048 MB of memory"),
        (partial(os.kill, 0, signal.SIGKILL), "killed from outside"),
    ],
    ids=["a mistake", "a division", "too much memory", "killed"],
)
def test_whatever_breaks_is_a_failure_that_says_so(call, words):
    with pytest.raises(PlanningFailed, match=words):
        in_one_process(call, limit_s=30.0)


@needs_proc
def test_at_the_limit_it_ends_with_all_that_it_started(tmp_path, monkeypatch):
    monkeypatch.setattr(process, "LATEST_S", 4.0)
    start = time.monotonic()
    with pytest.raises(PlanningFailed, match=r"no plan was found within 0\.1 s") as failed:
        in_one_process(partial(held_by_an_engine, tmp_path / "report"), limit_s=0.1)
    assert time.monotonic() - start < 0.1 + 5.0
    assert failed.value.cut_off
    assert is_gone(tmp_path / "report")


@needs_proc
@pytest.mark.parametrize("sent", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_it_ends_with_the_process_that_waits_for_it_however_that_ends(tmp_path, sent):
    script = tmp_path / "asking.py"
    here = Path(__file__).parent
    script.write_text(
        f"import signal, sys; sys.path.insert(0, {str(here)!r})\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from functools import partial\nfrom pathlib import Path\n"
        "from test_process import held_by_an_engine\n"
        "from comity_domain.custom.process import in_one_process\n"
        f"in_one_process(partial(held_by_an_engine, Path({str(tmp_path / 'report')!r})), limit_s=60.0)\n"
    )
    asking = subprocess.Popen([sys.executable, str(script)], stderr=subprocess.DEVNULL)
    for _ in range(600):
        if (tmp_path / "report").exists() and len((tmp_path / "report").read_text().split()) == 3:
            break
        time.sleep(0.1)
    asking.send_signal(sent)
    asking.wait(30)
    assert is_gone(tmp_path / "report")
