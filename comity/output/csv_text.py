"""Formats tables as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from typing import Any


def csv_text(heading: Iterable[Any], rows: Iterable[Iterable[Any]] = ()) -> str:
    """A line for the heading and one per row, each ended by a line feed on every platform."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(heading)
    writer.writerows(rows)
    return text.getvalue()
