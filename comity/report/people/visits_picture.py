"""Visits to one person as a picture: believed preference, actual distance, and the person's reactions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.drawing import BODY, COLOURS, FAINT, GREY, INK, LABEL, NOTE, sheet
from comity_fis.learning.signals import SAID

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.answers.visits import VisitsAnswer

BLUE, VERMILLION, GREEN = COLOURS[:3]
MARKS = {
    "step_back": ("^", VERMILLION),
    "ask_farther": ("^", VERMILLION),
    "turn_away": ("s", GREY),
    "lean_in": ("v", GREEN),
    "ask_closer": ("v", GREEN),
    "nothing": ("o", INK),
}
"""Markers by reaction: upwards if the person wanted more distance, downwards if less."""
NOTE_TEXT = (
    "A simulated person; every visit is an episode in the 2D world. The robot starts from the model's value "
    "and its spread, and learns only from what it saw and heard."
)


def visits_picture(answer: VisitsAnswer) -> Figure:
    """Distance over the number of the visit."""
    low, high = answer.likes_m
    figure, (ax,) = sheet(
        f"{answer.profile.replace('_', ' ')}: {len(answer.visits)} visits",
        f"At ease from {low:.2f} to {high:.2f} m, which the robot is not told. One visit every "
        f"{answer.every_days} days.",
        [4.4],
        note=NOTE_TEXT,
    )
    _draw_liked(ax, answer)
    _draw_believed(ax, answer)
    _draw_stops(ax, answer)
    ax.set_xlim(0.5, len(answer.visits) + 0.5)
    step = max(1, len(answer.visits) // 10)
    ax.set_xticks(range(1, len(answer.visits) + 1, step))
    ax.set_xlabel("visit", size=BODY, color=GREY)
    ax.set_ylabel("distance between the bodies [m]", size=BODY, color=GREY)
    ax.set_ylim(bottom=max(0.0, ax.get_ylim()[0]))
    _name_marks(ax, answer)
    return figure


def _draw_liked(ax: Axes, answer: VisitsAnswer) -> None:
    low, high = answer.likes_m
    ax.axhspan(low, high, color=GREEN, alpha=0.14, lw=0)
    ax.axhline((low + high) / 2, color=GREEN, lw=1.2)
    ax.text(
        0.008, high - 0.01, "at ease", size=LABEL, weight="bold", color=INK, ha="left", va="top",
        transform=ax.get_yaxis_transform(),
    )  # fmt: skip


def _draw_believed(ax: Axes, answer: VisitsAnswer) -> None:
    for visit in answer.visits:
        ax.plot([visit.visit] * 2, visit.interval_m, color=BLUE, lw=9, alpha=0.22, solid_capstyle="butt")
    models = [visit.distance_model_m for visit in answer.visits]
    ax.plot([visit.visit for visit in answer.visits], models, color=GREY, lw=1.4, ls=(0, (4, 3)))


def _draw_stops(ax: Axes, answer: VisitsAnswer) -> None:
    stops = [
        (visit.visit, visit.distance_actual_m, visit.noticed or "nothing")
        for visit in answer.visits
        if visit.distance_actual_m is not None
    ]
    ax.plot([at for at, _, _ in stops], [reached for _, reached, _ in stops], color=FAINT, lw=1.2, zorder=2)
    for at, reached, signal in stops:
        mark, ink = MARKS[signal]
        ax.plot(at, reached, mark, ms=10, mfc=ink, mec="white", mew=1.2, zorder=3)


def _name_marks(ax: Axes, answer: VisitsAnswer) -> None:
    """Legend of the markers that occur."""
    from matplotlib.lines import Line2D

    seen = dict.fromkeys(visit.noticed for visit in answer.visits if visit.noticed)
    handles = [
        Line2D([], [], ls="", marker=MARKS[signal][0], ms=9, color=MARKS[signal][1], label=SAID[signal])
        for signal in SAID
        if signal in seen
    ]
    handles.append(Line2D([], [], color=BLUE, lw=9, alpha=0.22, label="90 % interval"))
    handles.append(Line2D([], [], color=GREY, lw=1.4, ls=(0, (4, 3)), label="the model's value"))
    bottom, top = ax.get_ylim()
    ax.set_ylim(bottom, top + (0.06 + 0.07 * -(-len(handles) // 3)) * (top - bottom))
    ax.legend(handles=handles, fontsize=NOTE, frameon=False, labelcolor=GREY, ncols=3, loc="upper right")
