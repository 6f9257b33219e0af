"""The table of a study as Parquet, if pyarrow is installed."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity.study.statement import STATEMENT

if TYPE_CHECKING:
    from comity.study.table import StudyTable


def has_pyarrow() -> bool:
    """Whether Parquet can be written; `comity[study]` installs pyarrow."""
    return find_spec("pyarrow") is not None


def write_parquet(table: StudyTable, path: Path) -> None:
    """Write the rows with typed columns: integer, float, boolean or text."""
    import pyarrow
    from pyarrow import parquet

    columns, fields = [], []
    for name, definition in table.columns.items():
        values = [row.get(name) for row in table.rows]
        kind = _kind(values, definition.unit)
        fields.append(
            pyarrow.field(
                name, getattr(pyarrow, kind)(), metadata={"unit": definition.unit, "means": definition.means}
            )
        )
        columns.append(pyarrow.array([_as(kind, value) for value in values], getattr(pyarrow, kind)()))
    schema = pyarrow.schema(fields, metadata={"comity": STATEMENT})
    parquet.write_table(pyarrow.Table.from_arrays(columns, schema=schema), path)


def _kind(values: list[Any], unit: str) -> str:
    """The type of a column: from its values, or from its unit if it has none."""
    kinds = {type(value) for value in values if value is not None}
    if not kinds:
        return "float64" if unit else "string"
    if kinds == {bool}:
        return "bool_"
    if kinds == {int}:
        return "int64"
    return "float64" if kinds <= {int, float} else "string"


def _as(kind: str, value: Any) -> Any:
    if value is None:
        return None
    return {"float64": float, "string": str}.get(kind, lambda same: same)(value)
