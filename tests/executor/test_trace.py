"""The canonical encoding: the same events give the same bytes, and what was written can be read."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import (
    Cause,
    Node,
    TraceEvent,
    TraceFile,
    read_nodes,
    read_trace,
    trace_lines,
    trace_sha256,
)
from comity_executor.tracing.file import parts_of
from comity_fis.errors import InputError

KINDS = ["reading", "condition", "step", "parameter", "rule", "variable"]
causes = st.builds(
    Cause,
    kind=st.sampled_from(KINDS),
    text=st.text(),
    value=st.none() | st.text() | st.floats(-1e6, 1e6),
)
because = st.lists(causes, max_size=3).map(tuple)
halted = st.sampled_from(["preempted", "timed_out", "achieved_early", "parent_ended", "emergency"])
NODES = tuple(
    Node(path, f"node {path}", "action", None if path == 0 else 0, f"node {path}", (), None)
    for path in range(100)
)
nodes = st.sampled_from(NODES)
NODE = Node(0, "n", "action", None, "n", (), None)
HEADER = next(iter(trace_lines((), (NODE,))))
events = st.lists(
    st.builds(TraceEvent, st.floats(0, 1e4), nodes, st.just("halted"), halted, because)
    | st.builds(
        TraceEvent,
        st.floats(0, 1e4),
        nodes,
        st.sampled_from(["running", "success", "failure"]),
        st.none(),
        because,
    ),
    max_size=4,
).map(lambda many: tuple(sorted(many, key=lambda event: event.t)))


def write(path: Path, many: tuple[TraceEvent, ...], nodes: tuple[Node, ...] = NODES) -> None:
    with TraceFile(path, nodes) as trace:
        trace.keep(many)


@given(events, st.data())
def test_written_little_by_little_it_is_the_same_and_complete_at_any_moment(
    tmp_path_factory, many: tuple[TraceEvent, ...], data
) -> None:
    path = tmp_path_factory.getbasetemp() / "growing.jsonl"
    with TraceFile(path, ()) as trace:
        for so_far in sorted(data.draw(st.lists(st.integers(0, len(many)), max_size=4))):
            trace.keep(many[:so_far])
            assert path.read_text(encoding="utf-8").split("\n")[:-1] == list(trace_lines(many[:so_far]))
        trace.keep(many)
    assert path.read_text(encoding="utf-8").split("\n")[:-1] == list(trace_lines(many))


def test_a_line_that_was_cut_off_is_left_out(tmp_path: Path) -> None:
    """A process that was killed leaves half a line."""
    path = tmp_path / "trace.jsonl"
    header, line = HEADER, GOOD
    for cut in range(len(line)):
        path.write_text(f"{header}\n{line}\n{line[:cut]}")
        assert len(read_trace(path)) == 1


@given(events)
def test_what_was_read_is_written_again_to_the_byte(tmp_path_factory, many: tuple[TraceEvent, ...]) -> None:
    path = tmp_path_factory.getbasetemp() / "trace.jsonl"
    lines = tuple(trace_lines(many, NODES))
    write(path, many)
    assert tuple(trace_lines(read_trace(path), read_nodes(path))) == lines


@given(events, st.integers(1, 2_000))
def test_a_trace_in_parts_is_the_same_trace(
    tmp_path_factory, many: tuple[TraceEvent, ...], size: int
) -> None:
    """The parts together have the bytes of the whole, none is larger than asked for by more than a line."""
    path = tmp_path_factory.getbasetemp() / "parted.jsonl"
    lines = tuple(trace_lines(many, NODES))
    with TraceFile(path, NODES, part_bytes=size) as trace:
        trace.keep(many)
    parts = [part.read_bytes() for part in parts_of(path)]
    assert b"".join(parts).decode().split("\n")[:-1] == list(lines)
    assert all(len(part) < size + max(len(line.encode()) + 1 for line in lines) for part in parts)
    assert tuple(trace_lines(read_trace(path), NODES)) == lines


def test_no_more_people_may_read_a_later_part_than_the_first(tmp_path: Path) -> None:
    path = tmp_path / "trace.jsonl"
    path.touch(0o600)
    with TraceFile(path, (), part_bytes=1) as trace:
        trace.keep((TraceEvent(0.0, NODE, "running", None, ()),))
    assert [part.stat().st_mode & 0o777 for part in parts_of(path)] == [0o600, 0o600]


def test_a_damaged_line_of_a_later_part_is_named_with_its_file(tmp_path: Path) -> None:
    path = tmp_path / "trace.jsonl"
    path.write_text(f"{HEADER}\n")
    (tmp_path / "trace-2.jsonl").write_text("{}\n")
    with pytest.raises(InputError, match=r"trace-2\.jsonl:1"):
        read_trace(path)


@given(events)
def test_keys_are_sorted_and_every_line_is_one_object(many: tuple[TraceEvent, ...]) -> None:
    for line in trace_lines(many):
        record = json.loads(line)
        assert list(record) == sorted(record)
        assert "\n" not in line


@given(events)
def test_a_cause_is_written_out_once(many: tuple[TraceEvent, ...]) -> None:
    """From then on it is its number: what comes again and again costs a few bytes."""
    written = [
        json.dumps(cause, sort_keys=True)
        for line in trace_lines(many)
        for cause in json.loads(line).get("because", ())
        if isinstance(cause, dict)
    ]
    assert len(written) == len(set(written))


@pytest.mark.parametrize("changes", [{"path": 7}, {"path": -1}, {"name": "another"}])
def test_an_event_of_no_node_of_the_tree_is_refused(tmp_path: Path, changes: dict[str, Any]) -> None:
    event = TraceEvent(0.0, replace(NODE, **changes), "running", None, ())
    lines = [HEADER, *list(trace_lines((event,)))[1:]]
    (tmp_path / "trace.jsonl").write_text("".join(f"{line}\n" for line in lines))
    with pytest.raises(InputError, match="damaged"):
        read_trace(tmp_path / "trace.jsonl")


def test_the_digest_of_the_lines_is_that_of_the_file(episode, tmp_path: Path) -> None:
    import hashlib

    execution = episode().run().execution
    write(tmp_path / "trace.jsonl", execution.events, execution.nodes)
    assert hashlib.sha256((tmp_path / "trace.jsonl").read_bytes()).hexdigest() == execution.trace_sha256()


def test_a_whole_episode_can_be_read_back(episode, tmp_path: Path) -> None:
    execution = episode().run().execution
    write(tmp_path / "trace.jsonl", execution.events, execution.nodes)
    events = read_trace(tmp_path / "trace.jsonl")
    assert [(event.node, event.status) for event in events] == [
        (event.node, event.status) for event in execution.events
    ]


def test_two_executions_write_the_same_bytes(episode) -> None:
    first, second = (episode("johanna", "alice").run().execution.trace_lines() for _ in range(2))
    assert first == second


def test_the_hash_seed_does_not_show(episode) -> None:
    """Another PYTHONHASHSEED, the same digest."""
    script = (
        "from conftest import *;"
        "hall = Hall({'johanna': Stander(3.0, 0.0), 'alice': Stander(3.0, 2.0)});"
        "print(Episode(hall, plan_for('johanna', 'alice')).run().execution.trace_sha256())"
    )
    digests = {_output(script, hash_seed) for hash_seed in ("1", "2")}
    assert digests == {episode("johanna", "alice").run().execution.trace_sha256()}


def _output(script: str, hash_seed: str) -> str:
    path = os.pathsep.join([str(Path(__file__).parent), *sys.path])
    environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": path}
    done = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, check=True)
    return done.stdout.decode().strip()


def test_numbers_are_rounded_and_nothing_is_infinite() -> None:
    event = TraceEvent(0.1 + 0.2, NODE, "failure", None, (Cause("reading", "", float("nan")),))
    assert json.loads(list(trace_lines([event]))[1]) == {
        "t": 0.3,
        "node": "n",
        "path": 0,
        "status": "failure",
        "because": [{"kind": "reading", "text": ""}],
    }


def test_digests_differ_where_events_do() -> None:
    one, other = (TraceEvent(t, NODE, "running", None, ()) for t in (0.0, 0.05))
    assert trace_sha256(trace_lines([one])) != trace_sha256(trace_lines([other]))


GOOD = '{"because": [], "halt": null, "node": "n", "path": 0, "status": "running", "t": 1.0}'


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("{", "2"),
        ("[]", "2"),
        (GOOD.replace("running", "flying"), "status"),
        (GOOD.replace("1.0", '"late"'), "t"),
        (GOOD.replace('"path": 0, ', ""), "path"),
        (GOOD.replace("running", "halted"), "halted with halt None"),
        (GOOD.replace('"halt": null', '"halt": "preempted"'), "halt preempted"),
        (GOOD.replace("1.0", "NaN"), "t nan"),
        (GOOD + "\n" + GOOD.replace("1.0", "0.5"), "t 0.5 after 1.0"),
        (GOOD[:-20], "2"),
        (GOOD.replace("[]", "[0]"), "cause 0"),
        (GOOD.replace("[]", '[{"kind": "reading", "text": ""}, -1]'), "cause -1"),
    ],
)
def test_a_damaged_line_is_named_with_file_and_line(tmp_path: Path, line: str, complaint: str) -> None:
    path = tmp_path / "trace.jsonl"
    path.write_text(f"{HEADER}\n{line}\n")
    with pytest.raises(InputError, match="damaged") as caught:
        read_trace(path)
    assert caught.value.where.file == str(path)
    assert caught.value.where.line in (2, 3)
    assert complaint in str(caught.value)


@pytest.mark.parametrize("text", ["", "hello\n", '{"format": "comity-trace-2", "nodes": []}\n', "[1]\n"])
def test_what_is_no_trace_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "trace.jsonl"
    path.write_text(text)
    with pytest.raises(InputError, match="comity-trace-3"):
        read_trace(path)


def test_what_is_no_text_or_not_there_is_refused(tmp_path: Path) -> None:
    (tmp_path / "picture").write_bytes(b"\x89PNG\xff")
    for name in ("picture", "nowhere"):
        with pytest.raises(InputError, match="trace file"):
            read_trace(tmp_path / name)
