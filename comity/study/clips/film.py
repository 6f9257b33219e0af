"""MP4 from a GIF, where ffmpeg is installed: as a program, or by the package imageio-ffmpeg."""

from __future__ import annotations

import shutil
import subprocess
from importlib import import_module
from pathlib import Path

from comity_fis.errors import ComityError

EVEN = "scale=trunc(iw/2)*2:trunc(ih/2)*2"
"""H.264 with 4:2:0 colours takes even sizes only."""
EXACT = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact")
"""No date and no version in the file."""


INSTALL = "Debian: apt-get install ffmpeg; anywhere: pip install imageio-ffmpeg"
"""What brings ffmpeg."""


def ffmpeg_program() -> str | None:
    """The program: that on the path, else that of imageio-ffmpeg; None where there is neither."""
    if (found := shutil.which("ffmpeg")) is not None:
        return found
    try:
        return str(import_module("imageio_ffmpeg").get_ffmpeg_exe())
    except (ImportError, RuntimeError):  # it is not installed, or has no program for this platform
        return None


def write_mp4(program: str, gif: Path, path: Path) -> None:
    """Convert a GIF for players and survey programs that take none.

    Args:
        program: That of ffmpeg.
        gif: The film as it is.
        path: Of the MP4: the same frames at the same rate. The last frame is not held, as the GIF's is.

    Raises:
        ComityError: ffmpeg could not.
    """
    plays_anywhere = ("-pix_fmt", "yuv420p", "-movflags", "+faststart")
    words = [
        program,
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
