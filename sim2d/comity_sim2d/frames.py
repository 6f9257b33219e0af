"""The positions of the robot and of all people at every control tick."""

from __future__ import annotations

import csv
import math
from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from comity_fis.errors import InputError, Where
from comity_sim2d.kinds import PATH, require_kinds, wrong
from comity_sim2d.pose import Pose, wrap_angle
from comity_sim2d.scene_error import NUMBERS, require_tuple, unknown

COLUMNS = ("t", "entity", "x", "y", "heading_rad", "radius_m")


@dataclass(frozen=True, slots=True, eq=False)
class Frames:
    """The recorded poses of a world up to a moment; the robot is entity 0."""

    entities: tuple[str, ...]
    radius_m: tuple[float, ...]
    """Radius of each entity [m], at least 0."""
    time_s: NDArray[np.float64]
    """Times [s], shape (n,)."""
    poses: NDArray[np.float64]
    """Shape (n, entities, 3): x [m], y [m], heading [rad] in (-pi, pi]."""

    def __post_init__(self) -> None:
        require_tuple("frames", "entities", self.entities, str, "names")
        require_tuple("frames", "radius_m", self.radius_m, NUMBERS, "numbers")
        for field, part in (("time_s", self.time_s), ("poses", self.poses)):
            if not isinstance(part, np.ndarray) or part.dtype.kind not in "fiu":
                remedy = "Make one with `numpy.array(...)`."
                raise wrong("frames", field, f"{field} as an array of numbers", part, remedy)
        count, shape = len(self.entities), np.shape(self.poses)
        _require(count > 0, "at least the robot among the entities", "none")
        _require(len(set(self.entities)) == count, "a name of its own for every entity", f"{self.entities}")
        _require(len(self.radius_m) == count, f"{count} radii, one an entity", f"{len(self.radius_m)}")
        thinnest_m = min(self.radius_m)
        _require(not thinnest_m < 0.0, "radii of 0 m or more", f"{thinnest_m:g}")
        wanted = (len(self.time_s), count, 3)
        _require(shape == wanted, f"poses of the shape {wanted}: times, entities, and 3", f"{shape}")
        finite = all(np.isfinite(part).all() for part in (self.radius_m, self.time_s, self.poses))
        _require(finite, "numbers that are finite", "one that is not")
        _require(bool((np.diff(self.time_s) > 0.0).all()), "times that go up", "one that does not")

    def __len__(self) -> int:
        return len(self.time_s)

    def of(self, entity: str) -> NDArray[np.float64]:
        """The poses of one entity, shape (n, 3).

        Raises:
            ValueError: Where there is no entity of that name.
        """
        if entity not in self.entities:
            raise unknown("an entity of the frames", entity, self.entities)
        return self.poses[:, self.entities.index(entity)]

    def rows(self) -> Iterator[tuple[float, str, float, float, float, float]]:
        """Rows of `COLUMNS`, by time, then in the order of the entities."""
        for t, poses in zip(self.time_s.tolist(), self.poses.tolist(), strict=True):
            for entity, radius, (x, y, heading) in zip(self.entities, self.radius_m, poses, strict=True):
                yield (t, entity, x, y, heading, radius)


def _require(holds: bool, expected: str, got: str) -> None:
    if not holds:
        raise InputError(expected=f"frames with {expected}", got=got, remedy="Mend what they are made from.")


Row = tuple[float, float, float]
"""A pose in a frame: x [m], y [m], heading [rad]."""


def frame_row(pose: Pose) -> Row:
    """A pose as a row of a frame."""
    return (pose.x_m, pose.y_m, wrap_angle(pose.heading_rad))


class FrameRecorder:
    """Collects frames in compact arrays."""

    def __init__(self, bodies: Iterable[tuple[str, float]]) -> None:
        names_and_radii = list(bodies)
        self._entities = tuple(name for name, _ in names_and_radii)
        self._radius_m = tuple(radius for _, radius in names_and_radii)
        self._time = array("d")
        self._poses = array("d")

    def record(self, time_s: float, rows: Iterable[Row], rest: NDArray[np.float64] | None = None) -> None:
        """Add a frame: rows (x, y, heading) in the order of the bodies, the last ones as an array."""
        self._time.append(time_s)
        for row in rows:
            self._poses.extend(row)
        if rest is not None:
            self._poses.frombytes(rest.tobytes())

    def frames(self, since: int = 0) -> Frames:
        """A copy of the frames so far, without the first `since`."""
        shape = (-1, len(self._entities), 3)
        # Read directly from the buffer: a slice would be another copy of what may be hundreds of megabytes.
        poses = np.frombuffer(self._poses)[since * len(self._entities) * 3 :].copy().reshape(shape)
        time = np.array(self._time[since:])
        poses.flags.writeable = time.flags.writeable = False
        return Frames(self._entities, self._radius_m, time, poses)


def write_frames_csv(path: str | Path, frames: Frames) -> None:
    """Write one row per entity and frame; numbers read back to the same bits.

    Raises:
        SceneError: If `frames` are no frames; nothing is written then.
    """
    require_kinds("frames", path=(path, PATH), frames=(frames, Frames))
    with FramesFile(path) as file:
        file.keep(frames)


class FramesFile:
    """Frames on disk that grow while the world moves, so that a crash keeps what happened before it.

    Args:
        path: Where to write; an existing file is replaced.
    """

    def __init__(self, path: str | Path) -> None:
        require_kinds("frames", path=(path, PATH))
        self._file = Path(path).open("w", encoding="utf-8", newline="\n")  # noqa: SIM115  (closed by __exit__)
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(COLUMNS)
        self.count = 0
        """Frames written so far."""

    def keep(self, new: Frames) -> None:
        """Append frames that are not yet written."""
        require_kinds("frames", new=(new, Frames))
        self._writer.writerows(new.rows())
        self._file.flush()
        self.count += len(new)

    def __enter__(self) -> FramesFile:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()


def read_frames_csv(path: str | Path) -> Frames:
    """Read the complete frames of a file; a frame cut off when a run was killed is dropped.

    Raises:
        InputError: If it is no file of frames.
        OSError: If it cannot be read.
    """
    require_kinds("frames", path=(path, PATH))
    try:
        return _read(path)
    except (ValueError, KeyError, TypeError, InputError) as error:
        got = error.got if isinstance(error, InputError) else "a file that does not hold them"
        columns = ", ".join(COLUMNS)
        raise InputError(
            expected=f"frames of a run, in the columns {columns}",
            got=got,
            remedy="Name the frames.csv of a run's folder.",
            where=Where(str(path)),
        ) from error


def _read(path: str | Path) -> Frames:
    with Path(path).open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if line.endswith("\n")))
    entities = list(dict.fromkeys(row["entity"] for row in rows))
    whole = len(rows) - len(rows) % max(1, len(entities))
    recorder = FrameRecorder((name, float(rows[i]["radius_m"])) for i, name in enumerate(entities))
    for k in range(0, whole, max(1, len(entities))):
        block = rows[k : k + len(entities)]
        _require_everybody(block, entities, k + 2)
        recorder.record(float(block[0]["t"]), [frame_row(_pose(row)) for row in block])
    return recorder.frames()


def _require_everybody(block: list[dict[str, str]], entities: list[str], first_line: int) -> None:
    """Reject a frame with a missing row: all later rows would be assigned to the wrong entities."""
    for line, (row, name) in enumerate(zip(block, entities, strict=True), first_line):
        if (row["entity"], row["t"]) != (name, block[0]["t"]):
            got = f"line {line} of {row['entity']} at t={row['t']}, where {name} at t={block[0]['t']} is due"
            raise InputError(expected="everybody in their order", got=got, remedy="Add the row.")


def _pose(row: dict[str, str]) -> Pose:
    return Pose(float(row["x"]), float(row["y"]), math.remainder(float(row["heading_rad"]), math.tau))
