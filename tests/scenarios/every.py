"""Every scenario of the project: those that ship, and the tests' own, which do not."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from zlib import crc32

from comity.system.scenario_sets import SUFFIX, every_shipped
from comity.testing.collection.cases import Claim, claims_in
from comity.testing.trials.case import Across

OWN = {
    f"tests/{path.name.removesuffix(SUFFIX)}": path
    for path in sorted(Path(__file__).parent.glob(f"*{SUFFIX}"))
}
"""The tests' own, by the names that are used here."""
SCENARIOS = {**every_shipped(), **OWN}


def cases_of(name: str) -> Sequence[Claim]:
    """The tests of a scenario, but for comparisons of profiles."""
    return [claim for claim in claims_in(SCENARIOS[name]) if not isinstance(claim.case, Across)]


def sample_of(name: str) -> Claim:
    """One case, with another profile in each scenario, whichever scenarios there are."""
    cases = cases_of(name)
    return cases[crc32(name.encode()) % len(cases)]
