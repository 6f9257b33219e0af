"""`comity plan --domain`: the plan for a domain of the user's own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from comity.commands.options import print_json
from comity_fis.errors import InputError, Where

LEAST_S, MOST_S = 0.1, 86_400.0


def refuse_beside_domain(given: Mapping[str, object]) -> None:
    """Refuse what means nothing for a domain of the user's own.

    Args:
        given: What came, by option.

    Raises:
        InputError: for the first option that was given.
    """
    for option, value in given.items():
        if value:
            raise _refused(
                option,
                "either a scenario or a domain of your own",
                f"{option} beside --domain",
                "Leave it out: a binding names people's profiles and the rulebook.",
            )


def plan_own_domain(
    domain: Path | None,
    problem: Path | None,
    binding: Path | None,
    *,
    pddl: Path | None,
    limit_s: float,
    as_json: bool,
) -> None:
    """Plan PDDL files, bound to people where there is a binding.

    Raises:
        InputError: if anything given cannot be used.
        PlanningFailed: if no plan is found.
    """
    from comity.commands.progress import waiting
    from comity.own_domain import bound_domain
    from comity.pddl_files import DOMAIN, PROBLEM, write_texts
    from comity.report.own_plan import own_plan_answer, own_plan_text
    from comity.report.text import show
    from comity_domain.own import own_pddl, plan_own

    if domain is None or problem is None:
        missing = "--domain" if domain is None else "--problem"
        raise _refused(missing, "a PDDL file", "nothing", f"Add {missing} FILE.pddl.")
    if not LEAST_S <= limit_s <= MOST_S:
        seconds = f"from {LEAST_S:g} to {MOST_S:g} seconds"
        raise _refused("--limit", seconds, f"{limit_s:g}", "Give a number of seconds in this range.")
    bound = bound_domain(domain, problem, binding)
    renamed: Mapping[str, str] = {}
    files: tuple[str, ...] = ()
    if pddl is not None:
        texts = own_pddl(bound)
        write_texts(texts.domain, texts.problem, pddl)
        renamed, files = texts.renamed, (str(pddl / DOMAIN), str(pddl / PROBLEM))
    with waiting(f"searching for a plan, {limit_s:g} s at most", quiet=as_json):
        found = plan_own(bound, time_limit_s=limit_s)
    answer = own_plan_answer(bound, found, renamed=renamed, files=files)
    if as_json:
        print_json(answer)
    else:
        show(*own_plan_text(answer))


def _refused(option: str, expected: str, got: str, remedy: str) -> InputError:
    return InputError(expected=expected, got=got, remedy=remedy, where=Where(option))
