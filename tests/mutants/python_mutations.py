"""Changes of Python code: signs, operators, comparisons, guards, units, sides, stale parameters."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from tests.mutants.mutation import Mutation, words_of

STALE = {
    "conversational_distance": "approach_speed",
    "approach_speed": "conversational_distance",
    "approach_direction": "conversational_distance",
    "greeting_modality": "greeting_gesture",
    "greeting_gesture": "greeting_modality",
}
SIDES = {"left": "right", "right": "left", "front": "left"}
CALLS = {"min": "max", "max": "min", "cos": "sin", "sin": "cos"}
UNITS = ("radians", "degrees")
BINARY = {ast.Add: "-", ast.Sub: "+", ast.Mult: "/", ast.Div: "*"}
COMPARED = {ast.Lt: ">", ast.Gt: "<", ast.LtE: ">", ast.GtE: "<", ast.Eq: "!=", ast.NotEq: "=="}


WORDS = (
    "Account",
    "Why",
    "tuple[Why, ...]",
    "Iterator[Why]",
    "Cause",
    "tuple[Cause, ...]",
    "Iterator[Cause]",
)
"""What a function returns that only words reasons."""
NOTES = ("note", "notes", "text", "words", "said", "because", "why", "reason", "reasons")
"""What a statement is about that only words them."""
REFUSING = ("require", "refuse")
"""How the names of functions begin that only refuse bad input."""
ROUNDING = 1e-5
"""Numbers below this allow for rounding; nothing in a scenario is as small."""

REASONS = "words reasons"
REFUSALS = "refuses bad input"
TOLERANCES = "allows for rounding"
UNREACHED = "is executed by no scenario"
UNREAD = "is a constant that nothing executed reads"
UNLEFT = "is a guard that never leaves"
"""Why a place is left out."""


def mutations(
    root: Path, file: str, package: str, executed: Collection[int], read: Collection[str] | None = None
) -> Iterator[Mutation]:
    """All changes of one file, in lines that are executed.

    Args:
        root: The software.
        file: From there.
        package: Whose it is.
        executed: Its lines that are.
        read: The names that executed code reads; None for all.
    """
    yield from _searched(root, file, package, executed, read).found


def left_out(
    root: Path, file: str, package: str, executed: Collection[int], read: Collection[str] | None = None
) -> Mapping[str, int]:
    """How many other changes of the file are left out, by the reason; arguments as for `mutations`."""
    return _searched(root, file, package, executed, read).left_out


def _searched(
    root: Path, file: str, package: str, executed: Collection[int], read: Collection[str] | None
) -> _Finder:
    text = (root / file).read_text(encoding="utf-8")
    finder = _Finder(text, file, package, executed, read)
    finder.visit(ast.parse(text))
    return finder


class _Finder(ast.NodeVisitor):
    def __init__(
        self, text: str, file: str, package: str, executed: Collection[int], read: Collection[str] | None
    ) -> None:
        self._text, self._file, self._package, self._executed = text, file, package, executed
        self._read = read
        self._because: list[str] = []
        self.left_out: Counter[str] = Counter()
        self._lines = [0]
        for line in text.splitlines(keepends=True):
            self._lines.append(self._lines[-1] + len(line.encode()))
        self._bytes = text.encode()
        self._scope: list[str] = []
        self.found: list[Mutation] = []

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        self._scope.append(node.name)
        with self._leaving_out(REASONS, _words_reasons(node)), self._leaving_out(REFUSALS, _refuses(node)):
            for child in node.body:
                self.visit(child)
        self._scope.pop()

    def visit_Assign(self, node: ast.Assign) -> None:
        target, value = node.targets[0], node.value
        constant = not self._scope and isinstance(target, ast.Name) and isinstance(value, ast.Constant)
        if constant and isinstance(value.value, float) and target.id.rsplit("_", 1)[-1] in ("M", "S", "DEG"):
            unread = self._read is not None and target.id not in self._read
            with self._leaving_out(UNREAD, unread), self._leaving_out(TOLERANCES, _is_tolerance(value)):
                self._replace(value, f"{value.value * 10}", "unit", target.id)
        with self._leaving_out(REASONS, _named(target) in NOTES):
            self.generic_visit(node)

    def visit_Expr(self, node: ast.Expr) -> None:
        called = node.value.func if isinstance(node.value, ast.Call) else None
        one_more = isinstance(called, ast.Attribute) and _named(called.value) in NOTES
        with self._leaving_out(REASONS, one_more):
            self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        new = BINARY.get(type(node.op))
        if new and not _texts(node):
            left, right = self._source(node.left), self._source(node.right)
            family = "sign" if new in "+-" else "operator"
            with self._leaving_out(TOLERANCES, _is_tolerance(node.left) or _is_tolerance(node.right)):
                self._replace(node, f"({left}) {new} ({right})", family)
        self.generic_visit(node)

    def visit_Compare(self, node: ast.Compare) -> None:
        if len(node.ops) == 1 and (new := COMPARED.get(type(node.ops[0]))):
            self._replace(
                node, f"{self._source(node.left)} {new} {self._source(node.comparators[0])}", "comparison"
            )
        self.generic_visit(node)

    def visit_If(self, node: ast.If) -> None:
        if isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            return  # imports for types alone: the same software
        last = node.body[-1]
        raises = isinstance(last, ast.Raise) and last.lineno not in self._executed
        with self._leaving_out(REFUSALS, raises or all(map(_refuses, node.body))):
            self.visit(node.test)
            leaves = len(node.body) == 1 and isinstance(last, ast.Return | ast.Continue)
            if leaves and not node.orelse:
                with self._leaving_out(UNLEFT, last.lineno not in self._executed):
                    self._replace(node.test, "False", "guard removed")
            else:
                self._replace(node.test, f"not ({self._source(node.test)})", "condition")
            for child in (*node.body, *node.orelse):
                self.visit(child)

    @contextmanager
    def _leaving_out(self, reason: str, does: bool) -> Iterator[None]:
        """Leave out, and count, what is found inside; an outer reason goes before an inner one."""
        self._because += [reason] if does else []
        yield
        self._because = self._because[: -1 if does else None]

    def visit_IfExp(self, node: ast.IfExp) -> None:
        self._replace(node.test, f"not ({self._source(node.test)})", "condition")
        self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> None:
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        if name in CALLS:
            func = self._source(node.func)
            self._replace(node.func, func[: len(func) - len(name)] + CALLS[name], f"{name} for {CALLS[name]}")
        if name in UNITS and len(node.args) == 1:
            self._replace(node, f"({self._source(node.args[0])})", "unit")
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        if isinstance(node.value, str) and self._scope:
            for table, family in ((SIDES, "left for right"), (STALE, "stale parameter")):
                if node.value in table:
                    self._replace(node, repr(table[node.value]), family, node.value)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        if isinstance(node.op, ast.USub):
            self._replace(node, f"({self._source(node.operand)})", "sign")
        self.generic_visit(node)

    def _replace(self, node: ast.expr, new: str, family: str, *more: str) -> None:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        start = len(self._bytes[: self._lines[node.lineno - 1] + node.col_offset].decode())
        end = len(self._bytes[: self._lines[node.end_lineno - 1] + node.end_col_offset].decode())
        unreached = [UNREACHED] if node.lineno not in self._executed else []
        if reasons := (*self._because, *unreached):
            self.left_out[reasons[0]] += 1
            return
        old = self._text[start:end]
        culprits = words_of(Path(self._file).stem, *self._scope, old, *more)
        self.found.append(
            Mutation(self._package, self._file, node.lineno, family, start, end, old, new, culprits)
        )

    def _source(self, node: ast.AST) -> str:
        return ast.get_source_segment(self._text, node) or ""


def _words_reasons(node: ast.FunctionDef) -> bool:
    """Whether a function says what was done and why, and does nothing."""
    if node.returns is not None and ast.unparse(node.returns).removesuffix(" | None") in WORDS:
        return True
    if node.name.lstrip("_").startswith(("why", "because", "explain")):
        return True
    results = [child.value for child in ast.walk(node) if isinstance(child, ast.Return)]
    return bool(results) and all(map(_is_worded, results))


def _refuses(node: ast.AST) -> bool:
    """Whether a function, or a call alone, only refuses bad input, by its name."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
        called = node.value.func
        name = called.attr if isinstance(called, ast.Attribute) else _named(called)
    else:
        name = node.name if isinstance(node, ast.FunctionDef) else ""
    return name.lstrip("_").startswith(REFUSING)


def _is_tolerance(node: ast.expr) -> bool:
    """Whether it is a number that allows for rounding."""
    return isinstance(node, ast.Constant) and isinstance(node.value, float) and 0 < node.value < ROUNDING


def _is_worded(node: ast.expr | None) -> bool:
    """Whether it is a text with values in it."""
    if isinstance(node, ast.IfExp):
        return _is_worded(node.body) and _is_worded(node.orelse)
    return isinstance(node, ast.JoinedStr)


def _named(node: ast.AST) -> str:
    return node.id if isinstance(node, ast.Name) else ""


def _texts(node: ast.BinOp) -> bool:
    """Whether it joins texts or tuples: no arithmetic."""
    return any(
        isinstance(part, ast.JoinedStr | ast.Tuple | ast.List)
        or (isinstance(part, ast.Constant) and isinstance(part.value, str))
        for part in (node.left, node.right)
    )
