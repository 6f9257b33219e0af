"""Commands that take no blank word: what a shell makes of an unset variable would mean the current folder."""

from __future__ import annotations

from typing import Any

from typer.core import TyperCommand

from comity_fis.errors import InputError, Where

MAY_BE_BLANK = frozenset({"failed", "words", "answer", "node", "why"})
"""`comity test --failed ''` keeps nothing, `-k ''` takes every test, and an `--answer ''` leaves the question
open; the other two say what there is."""
IN_WORDS = {"DIR": "a folder", "FILE": "a file", "RUN": "a run folder"}
"""By what `--help` calls it, without a suffix."""


class Command(TyperCommand):
    """One that looks at its words before anything reads them: a path forgets that it was blank."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """As typer does.

        Raises:
            InputError: for a blank word.
        """
        given, _, _ = self.make_parser(ctx).parse_args(args=list(args))
        for param in self.params:
            values = given.get(param.name)
            words = values if isinstance(values, list | tuple) else (values,)
            blank = [word for word in words if isinstance(word, str) and not word.strip()]
            if blank and param.name not in MAY_BE_BLANK:
                raise _refused(param, blank[0])
        return super().parse_args(ctx, args)


def _refused(param: Any, word: str) -> InputError:
    option = param.opts[0] if param.opts[0].startswith("-") else None
    called = str(param.metavar or param.name.upper())
    expected = IN_WORDS.get(called.partition(".")[0], called if option else "a word")
    return InputError(
        expected=expected,
        got=repr(word),
        remedy="Name one." if param.required else "Name one, or leave it out.",
        where=Where(option or called.rstrip(".")),
    )
