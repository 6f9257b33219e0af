"""`comity`, also as `python -m comity`: it can be stopped from here on, while the rest is imported."""

import sys


def main() -> None:
    """Run the command line; its exit code is 130 after Ctrl-C and 143 after SIGTERM."""
    try:
        from comity.system.stopping import stoppable

        with stoppable():
            from comity.cli import main as command_line

            command_line()
    except KeyboardInterrupt:  # Python's own: what makes it ours was still being imported
        print("comity: interrupted", file=sys.stderr)
        sys.exit(130)


if __name__ == "__main__":
    main()
