"""Tables of an episode as pandas DataFrames; pandas is an extra."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from comity_executor.robots import senses
from comity_sim2d import frames

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pandas import DataFrame

    from comity_executor import ReadingSeries, TraceEvent
    from comity_sim2d import Frames

Table = Literal["frames", "events", "readings"]
EVENT_COLUMNS = ("t", "node", "path", "status", "halt", "because")


def frames_table(recorded: Frames) -> DataFrame:
    """Columns as in `frames.csv`; one row per control tick and entity."""
    return _table(recorded.rows(), frames.COLUMNS)


def readings_table(series: ReadingSeries) -> DataFrame:
    """Columns as in `readings.csv`; one row per reading of a person."""
    rows = ((person, *values.values()) for person, values in series.rows())
    return _table(rows, ("person", *senses.COLUMNS))


def events_table(events: Iterable[TraceEvent]) -> DataFrame:
    """One row per change of a node; its causes in words, the nearest first."""
    rows = (
        (one.t, one.node, one.path, one.status, one.halt, "; ".join(cause.text for cause in one.because))
        for one in events
    )
    return _table(rows, EVENT_COLUMNS)


def imported_pandas() -> Any:
    """The module.

    Raises:
        ImportError: if pandas is not installed; it says what to install.
    """
    try:
        import pandas
    except ImportError as error:
        raise ImportError(
            "expected pandas, which makes data frames, got none. Install it: pip install 'comity[pandas]'",
            name="pandas",
        ) from error
    return pandas


def _table(rows: Iterable[tuple[object, ...]], columns: Sequence[str]) -> DataFrame:
    return imported_pandas().DataFrame(list(rows), columns=list(columns))
