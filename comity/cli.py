"""The command line: which commands there are, and what an error looks like there."""

from __future__ import annotations

import sys

import typer

from comity.commands import convert, explain, figures, fit, infer, lists, plan, run, schema, trace
from comity_fis.errors import ComityError, InputError

app = typer.Typer(
    name="comity",
    help="Culture-aware behaviour for social robots, explained to the centimetre.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    epilog="Start with `comity run`. Exit codes: 0 done, 1 something was not reached, 2 bad input.",
)
for command in (
    run.run,
    infer.infer,
    explain.explain,
    plan.plan,
    trace.trace,
    lists.profiles,
    lists.rulebooks,
    lists.scenarios,
    convert.convert,
    schema.schema,
    fit.fit,
    figures.figures,
):
    app.command()(command)


def main() -> None:
    """Run the command line; bad input ends with 2, whatever else went wrong on purpose with 1."""
    try:
        app()
    except ComityError as error:
        print(f"comity: {error}", file=sys.stderr)
        sys.exit(2 if isinstance(error, InputError) else 1)
    except BrokenPipeError:
        # The reader (`| head`) has seen enough; Python would complain once more while closing.
        sys.stderr.close()
        sys.exit(0)
    except KeyboardInterrupt:
        print("comity: interrupted", file=sys.stderr)
        sys.exit(130)


if __name__ == "__main__":
    main()
