"""Export of stored personal data: a pseudonymous profile file with what was learnt as comments."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING, Any

from comity.people.store import EXPORT_MARK
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import InputError, Where
from comity_fis.validation.yaml_file import dump_yaml

if TYPE_CHECKING:
    from comity.people.learnt_file import Learning
    from comity.people.profile import Profile
    from comity.sharing.person import Filter

PSEUDONYM = re.compile(r"\w[\w-]{0,63}")


@dataclass(frozen=True, slots=True)
class Export:
    """A person under a pseudonym."""

    profile: dict[str, Any]
    learnt: list[dict[str, Any]]
    """Learnt data, by days since the first meeting."""

    @classmethod
    def of(
        cls, people: Filter, pseudonym: str, profile: Profile, day: date | None, learnt: Iterable[Learning]
    ) -> Export:
        """Create from the data that the filter lets through.

        Raises:
            InputError: for a pseudonym that is no portable file name.
        """
        if not PSEUDONYM.fullmatch(pseudonym):
            raise InputError(
                expected="a pseudonym of up to 64 letters, digits, `_` and `-`",
                got=repr(pseudonym),
                remedy="Choose another, such as P07.",
                where=Where("--pseudonym"),
            )
        return cls(people.profile(profile, day, pseudonym), people.learnt(learnt))

    @property
    def text(self) -> str:
        """The content of the profile file."""
        lessons = dump_yaml({DISTANCE: self.learnt}, inline=True).splitlines() if self.learnt else []
        lines = ["", "What was learnt, by days since the first:", *lessons] if lessons else []
        comments = "".join(f"# {line}".rstrip() + "\n" for line in lines)
        return f"{EXPORT_MARK}, under a pseudonym.\n{dump_yaml(self.profile, inline=True)}{comments}"

    def as_json(self) -> dict[str, Any]:
        """The export as JSON data."""
        return {"name": self.profile["name"], "profile": self.profile, "learnt": self.learnt}
