"""Which deadlines make a plan impossible, and which ones would be possible.

The cheap questions come first: which deadlines cannot be kept even as the only one; then which of the others,
lifted one at a time, or together where that is not enough. Where there is no time for that, the answer is a
set of deadlines that exclude each other for certain, which takes no measuring: a smallest one, if a second
more is enough for that; a single one that is out of reach, where there is any.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from comity.answers.plan import RelaxableCondition, Unmet
from comity_domain import Deadlines, VisitRequest, in_the_way
from comity_fis.listing import listed

By = Mapping[str, float]
"""Deadlines by person [s]."""
LATE_S = 1.0
"""So much longer deadlines that exclude each other are looked for: an answer late is better than none."""


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """Goals whose deadlines fail."""

    unmet: tuple[Unmet, ...] = ()
    """Empty where the deadlines are not in the way, or where that could not be told."""
    complete: bool = True
    """False where the time or the search did not do: there may be more of them, or fewer would do."""
    in_time: bool = True
    """False where the clock ended it, so that another time more may be known."""


def diagnose_deadlines(request: VisitRequest, *, ends_s: float) -> Diagnosis:
    """Whose deadline stands in the way of a plan, as far as there is time to tell.

    Args:
        request: What was asked, and has no plan.
        ends_s: When there is no more, by the machine's clock.
    """
    if not request.has_deadlines:
        return Diagnosis()
    worth = {each.name: each.priority_m for each in request.visitees}
    return _Diagnosing(Deadlines(request, ends_s=ends_s), worth, ends_s + LATE_S).diagnosis()


class _Diagnosing:
    """One diagnosis.

    Args:
        deadlines: Of those who must be visited.
        worth: Everybody's priority.
        last_s: When the last answer has to do, by the machine's clock.
    """

    def __init__(self, deadlines: Deadlines, worth: Mapping[str, float], last_s: float) -> None:
        self._deadlines = deadlines
        self._last_s = last_s
        # Who is worth more keeps their deadline where a choice is left: the first are put back first.
        self._by: By = dict(sorted(deadlines.by_s.items(), key=lambda item: -worth[item[0]]))
        self._complete = True

    def diagnosis(self) -> Diagnosis:
        hopeless = [name for name in self._by if self._kept({name: self._by[name]}) is False]
        rest = _without(self._by, hopeless)
        unmet = self._unmet(hopeless, rest) if self._complete else ()
        if not self._complete:
            unmet = tuple(self._too_soon(name, None) for name in hopeless) or tuple(self._excluding())
        return Diagnosis(unmet, self._complete, self._deadlines.in_time)

    def _unmet(self, hopeless: Sequence[str], rest: By) -> tuple[Unmet, ...]:
        """Those who are too far off, and those whose deadlines exclude each other's.

        Args:
            hopeless: Whose deadline cannot be kept even as the only one.
            rest: The other deadlines.
        """
        possible = self._kept(rest) is not False
        found = in_the_way((), bool) if possible else in_the_way(tuple(rest), self._possible_without(rest))
        lifted = found.all_of or found.any_of[:1]
        by = self._granted(_without(rest, lifted), hopeless)
        unmet = [self._too_soon(name, by.get(name)) for name in hopeless]
        if found.all_of:
            enough = self._granted(by, found.all_of)
            conditions = tuple(self._condition(name, enough.get(name)) for name in found.all_of)
            reason = "the deadlines cannot be kept together"
            unmet.append(Unmet(", ".join(found.all_of), reason, conditions, together=True))
        for name in found.any_of:
            # What the hopeless were granted goes with the first of these alternatives.
            fits = name in lifted or not hopeless
            granted = self._granted(_without({**by, **rest}, [name]), [name]) if fits else {}
            reason = "the deadline cannot be kept together with the others"
            if not fits:
                instead, others = listed(lifted), listed(hopeless)
                reason = (
                    f"the deadline may give way in the place of {instead}'s, with other ones for {others}"
                )
            unmet.append(Unmet(name, reason, (self._condition(name, granted.get(name)),), together=False))
        return tuple(unmet)

    def _possible_without(self, by: By) -> Callable[[Sequence[str]], bool]:
        return lambda lifted: self._kept(_without(by, lifted)) is True

    def _granted(self, by: By, names: Iterable[str]) -> By:
        """The deadlines with the least for these people that can all be kept."""
        for name in names:
            enough = self._deadlines.enough_s(name, {**by, name: self._by[name]})
            by = by if enough is None else {**by, name: enough}
        return by

    def _too_soon(self, name: str, enough: float | None) -> Unmet:
        """A person whose deadline is out of reach by itself."""
        own_s = self._by[name]
        earliest = self._deadlines.enough_s(name, {name: own_s})
        known = "" if earliest is None else f": {earliest} s is the first that a plan can promise"
        reason = f"the deadline of {own_s:g} s cannot be kept even if they are visited first{known}"
        return Unmet(name, reason, (self._condition(name, enough),), together=False)

    def _excluding(self) -> Iterable[Unmet]:
        """Deadlines that certainly cannot be kept together, as few as can be found by now."""
        if self._deadlines.may_be_kept(self._by, ends_s=self._last_s):
            return
        needed = self._by
        for name in self._by:
            fewer = _without(needed, [name])
            if not self._deadlines.may_be_kept(fewer, ends_s=self._last_s):
                needed = fewer
        together = " together" if len(needed) > 1 else ""
        conditions = tuple(self._condition(name, None) for name in needed)
        reason = f"{'these deadlines' if together else 'the deadline'} cannot be kept{together}"
        yield Unmet(", ".join(needed), reason, conditions, together=False, complete=False)

    def _kept(self, by: By) -> bool | None:
        kept = self._deadlines.kept(by)
        self._complete &= kept is not None
        return kept

    def _condition(self, name: str, enough: float | None) -> RelaxableCondition:
        """That a deadline were another one: `enough` in seconds; None: it is not known which would do."""
        own_s = self._by[name]
        by = f"later than {own_s:g} s" if enough is None else f"by {enough:g} s instead of {own_s:g} s"
        return RelaxableCondition("deadline", name, f"{name} could be greeted {by}")


def _without(by: By, names: Iterable[str]) -> By:
    left_out = set(names)
    return {name: s for name, s in by.items() if name not in left_out}
