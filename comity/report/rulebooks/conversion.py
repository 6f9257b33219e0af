"""What a conversion wrote, changed and lost."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from comity.report.text import table, unbroken

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.answers.inference import ConvertAnswer


def convert_text(answer: ConvertAnswer) -> Sequence[RenderableType]:
    """One line of what was written, the changes, the losses, and the check."""
    parts: list[RenderableType] = [
        unbroken(
            f"Wrote {answer.file} from {answer.source}: {_count(answer.variables, 'input')}, "
            f"{_count(answer.parameters, 'output')}, {_count(answer.rules, 'rule')}"
        )
    ]
    for head, items in (("In another form, or chosen", answer.changed), ("Not carried over", answer.lost)):
        if items:
            parts += [f"{head}:", table([("-", item) for item in items])]
    worst = ", ".join(f"{name} {gap:.2g}" for name, gap in answer.largest_differences.items())
    return (*parts, f"Read back, {answer.inputs_tried} inputs tried; largest differences: {worst}")


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"
