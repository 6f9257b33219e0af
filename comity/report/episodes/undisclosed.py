"""Undisclosed facts that outvoted disclosed ones at a time of a run, for the causes in its trace."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.output.run_folder import SCENARIO
from comity.parameters.cast import cast_of
from comity.report.values.inference import outvoted_text
from comity.scenario import load_scenario
from comity.simulation.changes import changes_of_values

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from comity.output.run_folder import RunFolder
    from comity_executor import Cause, TraceEvent
    from comity_fis import Inference


@dataclass(frozen=True, slots=True)
class Undisclosed:
    """Everybody's parameters in a run."""

    first: Mapping[str, Inference]
    """Initial parameters by person."""
    later: Sequence[tuple[float, str, Inference]]
    """Later parameters: start time [s], person, and parameters from then on."""

    def said(self, event: TraceEvent, cause: Cause) -> str:
        """Note for a parameter behind an event; empty for other causes, or if disclosed facts decided it."""
        about = event.person
        if cause.kind != "parameter" or about is None:
            return ""
        since = (values for t, person, values in self.later if person == about and t <= event.t)
        values = next(reversed([*since]), self.first.get(about))
        value = values.get(cause.text.split(" ")[0]) if values else None
        if values is None or value is None or value.value != cause.value:
            return ""
        return outvoted_text(value, values.inputs)


def undisclosed_in(folder: RunFolder) -> Undisclosed:
    """Read the parameters from the resolved scenario in a run folder.

    Raises:
        InputError: if it is missing or damaged.
    """
    cast = cast_of(load_scenario(str(folder / SCENARIO)))
    later = [(one.at_s, one.person, one.values) for one in changes_of_values(cast).values()]
    return Undisclosed(cast.values(), later)
