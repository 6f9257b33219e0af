"""Chooses an engine of unified-planning by problem kind and metric, or by its name.

The features an engine declares do not tell whether it respects the metric: many accept one and ignore it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

from comity_domain.custom.costs.classical import MAXIMIZED, beyond_classical, beyond_strips
from comity_domain.errors import NoEngine, PlanningFailed
from comity_fis.errors import InputError, Where, closest
from comity_fis.listing import listed

if TYPE_CHECKING:
    from collections.abc import Callable

    from unified_planning.engines import Factory
    from unified_planning.model import Problem

FAST_DOWNWARD = "fast-downward"
_PREFERRED = ("aries", "enhsp-opt", "enhsp", "tamer", "lpg", "symk-opt", "pyperplan")
"""Engines in order of preference; other installed ones follow alphabetically."""
_ANSWERED_BY_COST = ("fast-downward", "lpg", "lpg-anytime")
"""Engines that prove no optimum but do find cheap plans."""
_FREE = "pip install up-aries (MIT; whole numbers and durations)"
_JAVA = "pip install up-enhsp (GPL-3, needs Java 17; numeric, no durations)"
_EXTRA = "pip install 'comity[fast-downward]'"


_LACKS = (
    (
        {"GENERAL_NUMERIC_PLANNING"},
        "changes of a number by anything but a number that is written out, nor products",
        "Write a number, as in (increase (f) 2), with an action for each case",
    ),
    (
        {"REAL_FLUENTS", "REAL_TYPE_DURATIONS", "REAL_NUMBERS_IN_ACTIONS_COST"},
        "fractions",
        "Write it in whole numbers",
    ),
)
"""What aries, the engine for numbers and durations that pip installs without Java, does not support.

Each entry: the features of unified-planning, a description, and what to write instead. Quantifiers and
conditional effects are compiled away.
"""


def engine_for(problem: Problem) -> str:
    """The name of an installed engine that can solve a problem, preferably one that respects its metric.

    Raises:
        NoEngine: None can; the error names an engine to install.
    """
    able = [name for name in installed(problem.environment.factory) if _can(problem, name)]
    ranked = [name for name in _PREFERRED if name in able] + [name for name in able if name not in _PREFERRED]
    if not ranked:
        _refuse(problem)
    if problem.quality_metrics:
        ranked.sort(key=lambda name: not _sees_metric(problem, name))
    return ranked[0]


def without_quantifiers(problem: Problem) -> tuple[Problem, Callable[[Any], Any]] | None:
    """The problem without quantifiers, disjunctions and conditional effects, by unified-planning's compilers.

    Returns:
        The compiled problem and a map from its actions to the original ones; None if there is nothing to
        compile away, or the compilers fail.
    """
    from unified_planning.engines import CompilationKind

    kinds = [CompilationKind[f"{name}_REMOVING"] for name in beyond_strips(problem)]
    if not kinds:
        return None
    factory = problem.environment.factory
    try:
        with factory.Compiler(problem_kind=problem.kind, compilation_kinds=kinds) as compiler:
            result: Any = compiler.compile(problem)
            return result.problem, result.map_back_action_instance
    except Exception:  # any failure of a compiler means that there is no result
        return None


def require_able(engine: str, problem: Problem, *, classical: bool) -> None:
    """Reject a requested engine that cannot plan.

    Args:
        engine: Its name in unified-planning.
        problem: What it is to plan.
        classical: Whether Fast Downward can solve the problem: whatever its costs are named or typed, they
            are integers by now.

    Raises:
        InputError: The engine is not installed.
        NoEngine: The engine does not support the problem.
    """
    require_installed(engine, problem.environment.factory)
    able = [
        name
        for name in installed(problem.environment.factory)
        if not _lacking(problem, name) - ({"REAL_NUMBERS_IN_ACTIONS_COST"} if classical else set())
    ]
    if engine not in able:
        instead = f", or take one of: {', '.join(able)}" if able else ""
        reason = f"the engine {engine} does not take this problem"
        raise NoEngine(reason, remedy=f"Leave --engine out{instead}.")


def require_installed(engine: str, factory: Factory | None = None) -> None:
    """Reject an engine that unified-planning does not find.

    Args:
        engine: Its name there.
        factory: The factory to search; None takes the global one of unified-planning.

    Raises:
        InputError: The engine is not installed; the error names those that are.
    """
    from unified_planning.environment import get_environment

    names = installed(factory or get_environment().factory)
    if engine not in names:
        known = closest(engine, ["comity", *names])
        raise InputError(
            expected="the name of a planning engine that is installed",
            got=repr(engine),
            remedy=f"{known} Others come with packages such as up-fast-downward.",
            where=Where("--engine"),
        )


def broken_off(name: str, problem: Problem, text: str) -> PlanningFailed:
    """The failure to report when an engine aborts: unsupported features or its message, and alternatives.

    Args:
        name: Name of the engine.
        problem: The problem it was given.
        text: Its error message.
    """
    factory = problem.environment.factory
    lacks = _lacking(problem, name)
    able = [one for one in installed(factory) if not _lacking(problem, one)]
    instead = f"one of: {', '.join(able)}" if able else "another engine"
    if not lacks:
        return PlanningFailed(f"{name} broke off ({text})", remedy=f"Plan with {instead}.")
    words = listed(sorted(one.lower().replace("_", " ") for one in lacks))
    return PlanningFailed(
        f"{name} cannot plan this: it does not take {words}, which the problem has",
        remedy=f"Leave --engine out, or plan with {instead}.",
    )


def _lacking(problem: Problem, name: str) -> frozenset[str]:
    """Features of a problem that an engine does not support, not counting unused numeric functions."""
    supported = problem.environment.factory.engine(name).supported_kind().features
    return frozenset(problem.kind.features - supported - {"UNDEFINED_INITIAL_NUMERIC"})


def _plans(factory: Factory, name: str) -> bool:
    try:
        return bool(factory.engine(name).is_oneshot_planner())
    except Exception:  # an engine that cannot be loaded, for whatever reason, does not count
        return False


def installed(factory: Factory) -> list[str]:
    """The planners that unified-planning finds, without meta-engines."""
    return sorted(name for name in factory.engines if "[" not in name and _plans(factory, name))


def optimizes(engine: Any) -> bool:
    """Whether an engine that returns one plan optimises the metric, exactly or heuristically.

    Args:
        engine: Engine class of unified-planning.
    """
    from unified_planning.engines.mixins.oneshot_planner import OptimalityGuarantee

    proves = engine.is_oneshot_planner() and engine.satisfies(OptimalityGuarantee.SOLVED_OPTIMALLY)
    return bool(proves) or str(getattr(engine, "name", "")).lower() in _ANSWERED_BY_COST


def improves(engine: Any) -> bool:
    """Whether an engine is an anytime planner: it returns plans that improve by the metric, without a proof.

    Args:
        engine: Engine class of unified-planning.
    """
    from unified_planning.engines.mixins.anytime_planner import AnytimeGuarantee

    return bool(
        not optimizes(engine)
        and engine.is_anytime_planner()
        and engine.ensures(AnytimeGuarantee.INCREASING_QUALITY)
    )


def _sees_metric(problem: Problem, name: str) -> bool:
    """Whether an engine respects the metric; aries fails on action costs, which are then ignored."""
    engine = problem.environment.factory.engine(name)
    by_costs = problem.quality_metrics[0].is_minimize_action_costs()
    return optimizes(engine) or (improves(engine) and not (name == "aries" and by_costs))


def _can(problem: Problem, name: str) -> bool:
    return bool(problem.environment.factory.engine(name).supports(problem.kind))


def _refuse(problem: Problem) -> NoReturn:
    more, features = beyond_classical(problem), problem.kind.features
    if more is None:
        raise NoEngine(
            "a custom domain needs the planning engine Fast Downward, which is not installed",
            remedy=f"Install it with: {_EXTRA}.",
        )
    beyond = more.words
    has_aries = "aries" in problem.environment.factory.engines
    durative = problem.kind.has_continuous_time() or problem.kind.has_discrete_time()
    install = f"Install one: {_FREE}." if durative else f"Install one: {_FREE}, or {_JAVA}."
    if beyond == MAXIMIZED:
        install = f"Minimize what is lost instead, which needs no other engine; or: {_JAVA}."
    elif lack := next((one for one in _LACKS if one[0] & features), None):
        _, what, instead = lack
        has = "is installed, and" if has_aries else "could be installed, and"
        beyond = f"{beyond}; aries {has} takes no {what}"
        first = instead if has_aries else f"{instead}, and {_FREE}"
        install = f"{first}." if durative else f"{first}; or: {_JAVA}."
    raise NoEngine(f"no engine that is installed solves this problem, which has {beyond}", remedy=install)
