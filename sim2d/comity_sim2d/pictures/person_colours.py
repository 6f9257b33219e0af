"""The colour of each person: one source for pictures, animations and the page of a run.

Smallest difference between two colours (CIEDE2000), among the first six and the first twelve. Colour
blindness is simulated as by Machado, Oliveira and Fernandes (2009) at full severity. Names are always shown
as well.

|  | six, light | six, dark | twelve, light | twelve, dark |
|---|---|---|---|---|
| usual sight | 18.0 | 20.9 | 16.0 | 17.2 |
| protanopia | 8.3 | 8.1 | 6.7 | 8.0 |
| deuteranopia | 9.3 | 9.2 | 7.1 | 6.3 |
| tritanopia | 7.1 | 6.2 | 5.2 | 4.9 |
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from comity_sim2d.pictures.colours import LEAST_CONTRAST, PALETTE, contrast

GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
LIGHT_GROUND, DARK_GROUND = "#FFFFFF", "#22262D"
"""Background colours: the page of a picture, and the floor on a dark screen."""
SATURATION = {LIGHT_GROUND: 0.75, DARK_GROUND: 0.45}
"""Saturation of colours beyond the twelve, by background."""


@dataclass(frozen=True, slots=True)
class PersonColour:
    """The colour of one person; text in it has a contrast of at least 4.5 with its background."""

    on_light: str
    on_dark: str
    """Colour on a dark screen."""


DARKER = ("#D12C43", "#044642", "#4D552B", "#3E0D40", "#652125", "#312103")
LIGHTER = ("#56B4E9", "#F0914A", "#3CC79A", "#E08FBF", "#F7C645", "#8E81F9",
           "#FE7C7F", "#C1FBF2", "#C6FF05", "#FBDAFD", "#FFCFC0", "#DEE4A4")  # fmt: skip
DISTINCT = tuple(map(PersonColour, (*PALETTE, *DARKER), LIGHTER))
"""Distinct colours: found by random search for the largest minimum difference."""


def person_colours(people: Sequence[str]) -> dict[str, str]:
    """Colours on a light background by name, for people in the order of their scene."""
    return {name: person_colour(place).on_light for place, name in enumerate(people)}


def person_colour(place: int) -> PersonColour:
    """The colour of the person at an index, from 0; no two people have the same.

    After those of `DISTINCT`, hues are spaced by the golden ratio.
    """
    if place < len(DISTINCT):
        return DISTINCT[place]
    hue, step = place * GOLDEN % 1.0, place % 2
    return PersonColour(
        on_light=_legible(hue, (0.85, 0.6)[step], LIGHT_GROUND, darker=True),
        on_dark=_legible(hue, (0.75, 1.0)[step], DARK_GROUND, darker=False),
    )


def _legible(hue: float, brightness: float, ground: str, *, darker: bool) -> str:
    """A hue at the nearest brightness that text needs; paler if full brightness is not enough."""
    from matplotlib.colors import hsv_to_rgb, to_hex

    saturation, colour = SATURATION[ground], ground
    for i in range(50):
        value = brightness + (-i if darker else i) / 50
        paler = saturation * (1.0 - max(value - 1.0, 0.0))
        red, green, blue = hsv_to_rgb((hue, paler, min(max(value, 0.0), 1.0))).tolist()
        colour = to_hex((red, green, blue))
        if contrast(colour, ground) >= LEAST_CONTRAST:
            break
    return colour
