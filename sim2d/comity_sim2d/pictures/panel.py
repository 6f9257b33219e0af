"""The panel next to a map: a card for each visited person, and the legend. All lengths in inches."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.legend import ABOVE_IN, COLUMN_IN, Legend

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH_IN, MARGIN_IN, INDENT_IN = COLUMN_IN, 0.25, 0.28
CARD_IN, LINE_IN, NAME_LINE_IN = 0.98, 0.18, 0.21
CHARACTERS, NAME_CHARACTERS = 46, 20
"""Maximum number of characters of a line of small print, and of a line of a name, which shares the first one
with the side."""
SHORTEST_SCALE_M = 1.3
"""Minimum end of the bars' scale [m], beyond the largest distance of the shipped rules, for comparison."""
ROUNDING_IN = 1e-6
TRACK = "#F0F0F2"


@dataclass(frozen=True, slots=True)
class Card:
    """The content of a card about one visit."""

    person: str
    colour: str
    side: str
    wanted_m: float
    reached_m: float | None
    """Actual distance [m]; None: not reached."""
    notes: tuple[str, ...]

    @property
    def name_lines(self) -> list[str]:
        """The name, in as many lines as it needs."""
        return d.in_lines(self.person, NAME_CHARACTERS).splitlines()

    @property
    def lines(self) -> list[str]:
        """The notes as lines of small print."""
        return [line for note in self.notes for line in textwrap.wrap(note, CHARACTERS)]

    @property
    def longest_m(self) -> float:
        """The longest distance on it [m]."""
        return max(self.wanted_m, self.reached_m or 0.0)

    @property
    def height_in(self) -> float:
        """Its height [in]."""
        return CARD_IN + NAME_LINE_IN * (len(self.name_lines) - 1) + LINE_IN * len(self.lines)


@dataclass(frozen=True, slots=True)
class CardColumn:
    """Cards stacked vertically, with the legend below the last one."""

    cards: tuple[Card, ...]
    legend: Legend | None = None

    @property
    def height_in(self) -> float:
        """Its height [in]."""
        return sum(card.height_in for card in self.cards) + (self.legend.height_in if self.legend else 0.0)


def in_columns(cards: Sequence[Card], legend: Legend, most: int) -> list[CardColumn]:
    """Cards arranged in order in columns as low as possible, the legend in the last one.

    Args:
        cards: One per visit.
        legend: The legend of the picture.
        most: Maximum number of columns.
    """
    heights = sorted(
        {sum(card.height_in for card in cards[i:j]) for j in range(len(cards) + 1) for i in range(j)}
    )
    for highest in [height for height in heights if height >= legend.height_in] or heights:
        columns: list[CardColumn] = []
        for card in cards:
            if not columns or columns[-1].height_in + card.height_in > highest + ROUNDING_IN:
                columns.append(CardColumn(()))
            columns[-1] = CardColumn((*columns[-1].cards, card))
        if len(columns) < most:
            return [*columns, CardColumn((), legend)]
    return [CardColumn(tuple(cards), legend)]


def draw_column(ax: Axes, column: CardColumn, longest_m: float) -> None:
    """Fill the axes, scaled in inches of the page, from the top.

    Args:
        ax: The axes.
        column: The column to draw.
        longest_m: The longest distance on any card [m].
    """
    from matplotlib.transforms import Bbox

    box: Bbox = ax.get_position()
    wide, tall = (box.size * ax.figure.get_size_inches()).tolist()  # type: ignore[union-attr]
    ax.set_axis_off()
    ax.set_xlim(0.0, wide)
    ax.set_ylim(tall, 0.0)
    top = 0.0
    for card in column.cards:
        _draw_card(ax, top, card, max(longest_m * 1.05, SHORTEST_SCALE_M))
        top += card.height_in
    if column.legend is not None:
        if column.cards:
            ax.plot([0.0, WIDTH_IN - MARGIN_IN], [top, top], color=d.FAINT, lw=0.8)
        column.legend.draw(ax, top if column.cards else top - ABOVE_IN / 2)


def _draw_card(ax: Axes, top: float, card: Card, scale_m: float) -> None:
    """Draw the name, the side, target and actual distance as a bar and in numbers, and the notes."""
    from matplotlib.patches import Circle, Rectangle

    ax.add_patch(Circle((0.10, top + 0.14), 0.075, fc=card.colour, ec="none"))
    for i, line in enumerate(card.name_lines):
        y = top + 0.14 + NAME_LINE_IN * i
        ax.text(INDENT_IN, y, line, size=12, weight="bold", color=d.INK, va="center")
    right = WIDTH_IN - MARGIN_IN
    ax.text(right, top + 0.14, card.side, size=10, color=d.GREY, va="center", ha="right")
    scale = (right - INDENT_IN) / scale_m
    top += NAME_LINE_IN * (len(card.name_lines) - 1)
    for length, colour in ((scale_m, TRACK), (card.reached_m or 0.0, card.colour)):
        ax.add_patch(Rectangle((INDENT_IN, top + 0.34), scale * length, 0.13, fc=colour, ec="none"))
    mark = INDENT_IN + scale * card.wanted_m
    ax.plot([mark, mark], [top + 0.28, top + 0.53], color=d.INK, lw=2.0, ls=(0, (2.2, 1.2)))
    actual = "not reached" if card.reached_m is None else f"actual {card.reached_m:.3f} m"
    words = f"target {card.wanted_m:.3f} m, {actual}"
    ax.text(INDENT_IN, top + 0.66, words, size=10, color=d.INK, va="center")
    for i, line in enumerate(card.lines):
        ax.text(INDENT_IN, top + 0.85 + LINE_IN * i, line, size=9, color=d.GREY, va="center")
