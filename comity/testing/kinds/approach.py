"""The side from which the robot approaches."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes
from comity.testing.amounts.amount import told
from comity.testing.amounts.standing import standing
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.visits import approached, require_goal
from comity_fis.listing import listed

if TYPE_CHECKING:
    from comity.episode import Episode


@dataclass(frozen=True, slots=True)
class ApproachSide(Expectation):
    """The side, from the person's point of view, on which the robot stands after docking."""

    RULE: ClassVar[str] = (
        "_APPROACH [_TO NAME] _FROM (FRONT | LEFT | RIGHT | BACK) (_OR (FRONT | LEFT | RIGHT | BACK))*"
    )
    EXAMPLE: ClassVar[str] = "approach to johanna from the front"

    person: str | None
    sides: tuple[str, ...]

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a name and sides."""
        person, *sides = parts
        return cls(person, tuple(side.lower() for side in sides))

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Each person approached from another side."""
        require_goal(episode.prepared.file.scenario, *self.people)
        for person in self.people or approached(episode.prepared.plan):
            stood = standing(episode.frames, episode.visits, person)
            expected = f"{listed(self.sides, 'or')} of {person}"
            if stood is None:
                because = tuple(causes.of_visit(episode, person))
                yield Finding(expected, "the robot never stopped there", because)
            elif stood.side not in self.sides:
                got = f"{stood.side}, at {told(stood.bearing_deg, 'deg')}, at t={stood.t:.2f} s"
                because = (
                    *causes.of_visit(episode, person),
                    *causes.of_node(episode.history, f"docked?({person})", "success", ended_s=stood.t),
                    *causes.of_parameter(episode, "approach_direction", person, stood.t),
                )
                yield Finding(expected, got, because)
