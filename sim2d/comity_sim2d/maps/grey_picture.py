"""Reads a PGM or PNG as shades of grey."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from warnings import catch_warnings

import numpy as np
from numpy.typing import NDArray

from comity_fis.errors import InputError
from comity_fis.validation.no_file import no_file

if TYPE_CHECKING:
    from PIL import Image

MAX_CELLS = 16_000_000
"""Maximum number of cells of a picture (our choice: 200 m x 200 m in cells of 5 cm)."""
FORMATS = ("PPM", "PNG")
"""Pillow's names of the formats; its PPM includes PGM."""
DEEP = 65535.0
"""Value of white in a 16-bit picture."""


@dataclass(frozen=True, slots=True, eq=False)
class GreyPicture:
    """The pixels of a picture, the top row first."""

    grey: NDArray[np.float64]
    """Mean of the colour channels, shape (rows, columns), from 0 for black to 1 for white."""
    opaque: NDArray[np.float64]
    """Opacity, from 0 for transparent to 1, of the same shape."""
    has_alpha: bool


def read_grey(path: Path, name: str) -> GreyPicture:
    """Read a PGM or PNG.

    Args:
        path: The file.
        name: Its name in messages.

    Raises:
        InputError: If the file does not exist, has another format, is broken or too large.
    """
    from PIL import Image, UnidentifiedImageError

    expected = "a PGM or PNG file"
    try:
        if not path.is_file():
            raise _refused(
                expected, f"{no_file(path)}: {name}", "Check the path, which starts at this file's folder."
            )
        with catch_warnings(action="error", category=Image.DecompressionBombWarning):
            picture = Image.open(path, formats=FORMATS)
        with picture:
            width, height = picture.size
            if width * height > MAX_CELLS:
                raise _too_large(f"{name} with {width} x {height}")
            return _grey(picture)
    except (Image.DecompressionBombWarning, Image.DecompressionBombError):  # at five times as many cells
        raise _too_large(f"many times as many in {name}") from None
    except UnidentifiedImageError:
        raise _refused(expected, f"{name}, which is neither", "Save the map as PGM or PNG.") from None
    except (OSError, ValueError, SyntaxError) as error:
        raise _refused(expected, f"{name}, which is broken: {error}", "Save the map again.") from None


def _refused(expected: str, got: str, remedy: str) -> InputError:
    return InputError(expected=expected, got=got, remedy=remedy)


def _too_large(got: str) -> InputError:
    return _refused(f"a picture of at most {MAX_CELLS:,} cells", got, "Cut it, or make its cells larger.")


def _grey(picture: Image.Image) -> GreyPicture:
    if picture.mode == "P":
        picture = picture.convert("RGBA" if "transparency" in picture.info else "RGB")
    if picture.mode == "1":
        picture = picture.convert("L")
    values = np.asarray(picture, dtype=np.float64)
    values = values / (DEEP if picture.mode.startswith("I") else 255.0)
    if values.ndim == 2:
        return GreyPicture(values, np.ones(values.shape), has_alpha=False)
    has_alpha = picture.mode in ("LA", "RGBA")
    grey = (values[..., :-1] if has_alpha else values).mean(axis=-1)
    opaque = values[..., -1] if has_alpha else np.ones(values.shape[:2])
    return GreyPicture(grey, opaque, has_alpha=has_alpha)
