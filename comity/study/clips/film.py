"""Conversion of GIF to MP4, if ffmpeg is installed: as a program, or through the package imageio-ffmpeg."""

from __future__ import annotations

import shutil
import subprocess
from importlib import import_module
from pathlib import Path

from comity_fis.errors import ComityError

EVEN = "scale=trunc(iw/2)*2:trunc(ih/2)*2"
"""H.264 with 4:2:0 chroma subsampling requires even sizes."""
EXACT = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact")
"""Options that keep date and version out of the file."""


INSTALL = "Debian: apt-get install ffmpeg; anywhere: pip install imageio-ffmpeg"
"""How to install ffmpeg."""


def ffmpeg_program() -> str | None:
    """Path of ffmpeg: from PATH, else from imageio-ffmpeg; None if there is neither."""
    if (found := shutil.which("ffmpeg")) is not None:
        return found
    try:
        return str(import_module("imageio_ffmpeg").get_ffmpeg_exe())
    except (ImportError, RuntimeError):  # not installed, or without a program for this platform
        return None


def write_mp4(program: str, gif: Path, path: Path) -> None:
    """Convert a GIF for players and survey programs that do not accept GIFs.

    Args:
        program: Path of ffmpeg.
        gif: The input GIF.
        path: Output path; the MP4 has the same frames and rate, but the last frame is not held as in the GIF.

    Raises:
        ComityError: if ffmpeg failed.
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
