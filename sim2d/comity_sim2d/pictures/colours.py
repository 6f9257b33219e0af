"""Colours of pictures: easy to distinguish, and legible as text."""

from __future__ import annotations

PALETTE = ("#006BA6", "#B64C00", "#007A58", "#A8467F", "#6B4100", "#443898")
"""The first five colours of Okabe and Ito (2008), darkened as text needs, the orange still darker, and an
indigo.

The contrast with white is at least 4.5 (WCAG 2.2, criterion 1.4.3).
"""
INK, GREY = "#22252B", "#5F646C"
"""Colours of text and of small print."""
FAINT = "#B9BDC4"
"""Colour of lines only: too light for text."""
HALO = "#FFFFFF"
"""Colour of the halo around text on a map."""
LEAST_CONTRAST = 4.5


def contrast(one: str, other: str) -> float:
    """The contrast ratio of two colours, from 1 to 21, as WCAG 2.2 defines it."""
    from matplotlib.colors import to_rgb

    light, dark = sorted((_luminance(to_rgb(one)), _luminance(to_rgb(other))), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(rgb: tuple[float, float, float]) -> float:
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in rgb)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
