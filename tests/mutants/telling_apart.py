"""Can random episodes tell changed software from the original? The oracle for changes that survived.

It knows nothing of the scenarios that judge: it runs both over the same random scenarios and compares all
that comes of them, but for rounding. What not one of them tells apart may be an equivalent change, which no
test could catch; whether it is one cannot be decided in general, so that it "cannot be told apart" by so many
episodes.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import resource
import signal
from collections.abc import Collection, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.mutants.attempt import MOST_BYTES, settle
from tests.mutants.progress import counted
from tests.mutants.random_scenarios import random_scenario
from tests.mutants.reach import executed, forget

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.preparation import PlannedEpisode

FILE = "random"
ANSWER = "apart.json"
MOST_CPU_S = 25.0
"""For one change; what was not tried until then is not tried."""
DIGITS = 9
"""Behind the point: the same number reckoned in another order may end in other digits."""
NUMBER = re.compile(r"-?\d+(?:\.\d+(?:e[-+]?\d+)?|e[-+]?\d+)")


@dataclass(frozen=True)
class Known:
    """One random episode of the original software."""

    number: int
    takes_s: float
    digests: dict[str, str]
    """Of the values, the plan, the trace, the frames and the result."""
    lines: dict[str, list[int]]
    """By file from the root: what it executes."""


@dataclass(frozen=True)
class Apart:
    """Whether one of the random episodes tells a change from the original."""

    by: int | None
    """The first one that does; None where none does."""
    what: str
    """What came out otherwise in it."""
    tried: int
    """Episodes until then, of those that execute what was changed."""

    @property
    def words(self) -> str:
        """What they say, for the table."""
        if not self.tried:
            return "no random episode comes to it"
        if self.by is None:
            return f"not one of {self.tried} random ones"
        return f"random episode {self.by} does ({self.what})"


def measure(root: Path, scratch: Path, numbers: range) -> None:
    """Run random scenarios, twice each, and write what came of them into the scratch folder.

    What the software refuses is left out, and what does not come out twice alike.

    Args:
        root: An unchanged copy of the software.
        scratch: For the answer.
        numbers: To draw scenarios from.
    """
    settle(root, scratch)
    drawn = counted("what comes of a random scenario,", numbers, every=10)
    found = [known for number in drawn if (known := _known(number, root))]
    file = scratch / f"{FILE}-{numbers.start}.json"
    file.write_text(json.dumps([asdict(known) for known in found]), encoding="utf-8")


def read(scratch: Path) -> list[Known]:
    """What `measure` wrote."""
    files = sorted(scratch.glob(f"{FILE}-*.json"))
    return [Known(**each) for file in files for each in json.loads(file.read_text(encoding="utf-8"))]


def _known(number: int, root: Path) -> Known | None:
    from coverage import Coverage

    coverage = Coverage(data_file=None, source=[str(root)], config_file=False)
    forget()
    coverage.start()
    digests = _digests(number)
    coverage.stop()
    if "refused" in digests:
        return None
    before = _cpu_s()
    again = _digests(number)
    return Known(number, _cpu_s() - before, digests, executed(coverage, root)) if again == digests else None


def tell_apart(root: Path, scratch: Path, known: Path, file: str, line: int | None) -> None:
    """Try random episodes on a changed copy, the quick ones first, until one differs; and leave an answer.

    Args:
        root: The copy.
        scratch: For the answer.
        known: The folder with what was measured of the original.
        file: What was changed, from the root.
        line: In which line; None where all episodes may notice.
    """
    settle(root, scratch)
    most = int(MOST_CPU_S * 3)
    resource.setrlimit(resource.RLIMIT_CPU, (most, most))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    signal.signal(signal.SIGPROF, _give_up)
    episodes = [one for one in read(known) if line is None or line in one.lines.get(file, ())]
    answer = _told(sorted(episodes, key=lambda one: one.takes_s))
    (scratch / ANSWER).write_text(json.dumps(asdict(answer)), encoding="utf-8")


def _told(episodes: Collection[Known]) -> Apart:
    start, tried = _cpu_s(), 0
    for known in episodes:
        if _cpu_s() - start > MOST_CPU_S:
            break
        tried += 1
        if (what := _difference(known)) and _difference(known):
            return Apart(known.number, what, tried)
    return Apart(None, "", tried)


def _difference(known: Known) -> str:
    """What comes out otherwise than in the original; empty where nothing does."""
    signal.setitimer(signal.ITIMER_PROF, 5.0 + 10.0 * known.takes_s)
    try:
        digests = _digests(known.number)
    except BaseException as error:
        return type(error).__name__
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
    parts = sorted(known.digests.keys() | digests.keys())
    return ", ".join(part for part in parts if known.digests.get(part) != digests.get(part))


class NoEnd(BaseException):
    """An episode takes ten times as long as in the original. No `Exception`: the tree handles those."""


def _give_up(*_: object) -> None:
    raise NoEnd


def _digests(number: int) -> dict[str, str]:
    """Of all that comes of one scenario; where it has no plan, of the reason for that."""
    from comity.live_episode import execute
    from comity.planning.diagnosis import GoalsUnmet
    from comity.preparation import prepare
    from comity.scenario import load_scenario
    from comity_fis import InputError

    path = Path(f"random-{number}.scenario.yaml")
    path.write_text(random_scenario(number), encoding="utf-8")
    try:
        prepared = prepare(load_scenario(str(path)), seed=number)
    except GoalsUnmet as unmet:
        return {"no plan": _digest(str(unmet))}
    except InputError as error:
        return {"refused": str(error)}
    episode = execute(prepared, seed=number)
    return {what: _digest(*parts) for what, parts in _told_of(prepared, episode)}


def _told_of(prepared: PlannedEpisode, episode: Episode) -> Iterator[tuple[str, tuple[Any, ...]]]:
    """All that is compared: numbers but for rounding, the trace with its reasons, and no text of a plan's."""
    plan = prepared.plan
    values = [
        (name, [(key, one.value, one.origin) for key, one in each.parameters.items()])
        for everybody in (prepared.values, episode.values)
        for name, each in everybody.items()
    ]
    yield "values", (values,)
    yield "plan", (plan.cost, plan.bound, plan.optimal, _steps(plan.steps), _steps(episode.steps))
    yield "trace", (episode.trace_sha256,)
    frames = episode.frames
    yield "frames", (frames.entities, frames.time_s.tobytes(), (frames.poses.round(DIGITS) + 0.0).tobytes())
    yield "result", (episode.outcome, episode.visits, episode.acts, episode.door_turns)


def _steps(steps: Collection[Any]) -> list[tuple[Any, ...]]:
    """The steps of a plan, each with what other choices would cost."""
    return [
        (
            step.action,
            step.arguments,
            step.origin,
            dict(step.parameters),
            step.cost,
            dict(step.cost_parts),
            step.companions,
            [(other.arguments, other.extra_cost) for other in step.why.alternatives],
            [other.arguments for other in step.why.ruled_out],
        )
        for step in steps
    ]


def _digest(*parts: Any) -> str:
    text = NUMBER.sub(lambda found: f"{round(float(found[0]), DIGITS) + 0.0}", repr(parts))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _cpu_s() -> float:
    """Processor time of this process and of the engines that it started."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system
