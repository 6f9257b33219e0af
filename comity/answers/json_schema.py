"""The JSON schema of an answer: its fields with their docstrings as descriptions."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
from dataclasses import is_dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic.json_schema import GenerateJsonSchema

from comity_fis.record import Record, key_of, reader

if TYPE_CHECKING:
    from pydantic_core.core_schema import DataclassSchema


def schema_of(kind: type[Record]) -> dict[str, Any]:
    """The JSON schema of a kind of record."""
    return reader(kind).json_schema(schema_generator=_Described)


class _Described(GenerateJsonSchema):
    """Pydantic's schema, with the docstring below a field as the field's description."""

    def dataclass_schema(self, schema: DataclassSchema) -> dict[str, Any]:
        """The schema of one record."""
        found = super().dataclass_schema(schema)
        for kind in reversed(schema["cls"].__mro__):
            for field, text in _documented(kind) if is_dataclass(kind) else ():
                found["properties"][key_of(field)]["description"] = text
        return found


def _documented(kind: type) -> Iterator[tuple[str, str]]:
    """The fields that a class declares itself and documents, with the text."""
    statements = _classes(Path(inspect.getfile(kind)))[kind.__qualname__].body
    for declared, below in pairwise(statements):
        match declared, below:
            case ast.AnnAssign(target=ast.Name(id=field)), ast.Expr(value=ast.Constant(value=str(text))):
                yield field, inspect.cleandoc(text).replace("\n", " ")


@cache
def _classes(file: Path) -> dict[str, ast.ClassDef]:
    tree = ast.parse(file.read_text(encoding="utf-8"))
    return {one.name: one for one in tree.body if isinstance(one, ast.ClassDef)}
