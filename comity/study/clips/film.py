"""MP4 from a GIF, where ffmpeg is installed."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from comity_fis.errors import ComityError

EVEN = "scale=trunc(iw/2)*2:trunc(ih/2)*2"
"""H.264 with 4:2:0 colours takes even sizes only."""
EXACT = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact")
"""No date and no version in the file."""


def has_ffmpeg() -> bool:
    """Whether the program is on the path."""
    return shutil.which("ffmpeg") is not None


def write_mp4(gif: Path, path: Path) -> None:
    """Convert a GIF for players and survey programs that take none.

    Raises:
        ComityError: ffmpeg could not.
    """
    plays_anywhere = ("-pix_fmt", "yuv420p", "-movflags", "+faststart")
    words = [
        "ffmpeg",
        "-y",
        "-loglevel",
        "error",
        "-i",
        str(gif),
        "-vf",
        EVEN,
        *plays_anywhere,
        *EXACT,
        str(path),
    ]
    done = subprocess.run(words, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode:
        told = (done.stderr.strip().splitlines() or ["nothing"])[-1]
        raise ComityError(
            f"expected {path.name} from ffmpeg, got: {told}. The GIF is there; convert it by hand."
        )
