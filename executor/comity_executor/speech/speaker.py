"""Selects what the robot says by language, formality, directness and style, with forms of address."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from comity_domain.problem.bound_parameters import GREETING_LANGUAGE
from comity_executor.speech.address import Address
from comity_executor.speech.phrasebook import DEFAULT_LANGUAGE, SHIPPED, Phrasebook
from comity_executor.speech.utterance import Called, Utterance
from comity_executor.speech.wording import Register, Use, Wording
from comity_fis.errors import InputError, closest
from comity_fis.inference.value import Inference

INFORMAL = 0.3
FORMAL = 0.7
"""Thresholds of formality: informal below the one, formal above the other; crossings of `evidence`'s
terms."""
RHETORICAL = 0.5
"""Style above which an additional phrase is said at a first meeting."""
IMPLICIT = 0.45
EXPLICIT = 0.55
"""Thresholds of directness; in between the robot adds nothing. Our choice, near the crossing of the terms."""
BESIDE_DEG = 30.0
BEHIND_DEG = 150.0
"""Bearings up to the first are in front, beyond the second behind, otherwise left or right (our choice)."""


@dataclass(frozen=True, kw_only=True)
class Speaker:
    """Chooses the words of one robot at one site.

    The language is the person's parameter `greeting_language`, or the site's if that is unknown or not in the
    rulebook.
    """

    phrasebook: Phrasebook = SHIPPED
    site: str = DEFAULT_LANGUAGE
    """The language of the site, by its code in the phrasebook."""
    addresses: Mapping[str, Address] = field(default_factory=dict)
    """Forms of address that people asked for, by person."""
    reviewed_only: bool = False
    """Whether unreviewed wordings are avoided: then the robot says the name and the plainest word in the
    language of the site."""

    def greeting(self, people: Sequence[str], values: Inference) -> Utterance:
        """Greeting for one person or a group; without speech parameters just a hello.

        Args:
            people: The people to greet.
            values: Parameters of the person the robot stands next to.

        Raises:
            InputError: The rulebook uses one of these parameters with another meaning.
        """
        besides = (*_style(values), *_help(values))
        return self._said("greet", people, values, besides=besides)

    def handing_over(self, person: str, thing: str, values: Inference) -> Utterance:
        """Words for handing over an object, which is named as in the scenario."""
        return replace(self._said("hand_over", (person,), values), thing=thing)

    def farewell(self, person: str, values: Inference, *, leaving: bool = False) -> Utterance:
        """Words for saying goodbye, as formal as the greeting.

        Args:
            person: The addressee.
            values: Their parameters.
            leaving: Whether to announce leaving as well, to a person who cannot see.
        """
        if leaving:
            return self._said("announce_leaving", (person,), values, besides=("take_leave",))
        return self._said("take_leave", (person,), values)

    def coming(self, person: str, values: Inference) -> Utterance:
        """Announcement that the robot approaches, to a person who cannot see."""
        return self._said("announce_coming", (person,), values)

    def stopped(self, person: str, bearing_deg: float, values: Inference) -> Utterance:
        """Announcement of where the robot has stopped, to a person who cannot see.

        Args:
            person: The addressee.
            bearing_deg: The robot's bearing as the person would see it, in (-180, 180], positive to their
                left [deg].
            values: Their parameters.
        """
        if abs(bearing_deg) <= BESIDE_DEG:
            use: Use = "stopped_in_front"
        elif abs(bearing_deg) >= BEHIND_DEG:
            use = "stopped_behind"
        else:
            use = "stopped_left" if bearing_deg > 0.0 else "stopped_right"
        return self._said(use, (person,), values)

    def leaving(self, person: str, values: Inference) -> Utterance:
        """Announcement that the robot leaves, to a person who cannot see."""
        return self._said("announce_leaving", (person,), values)

    def request_to_pass(self, person: str, values: Inference | None) -> Utterance:
        """Request to a person who obstructs the path.

        Args:
            person: The addressee.
            values: Their parameters; None for an unknown person, who is then not named.

        Raises:
            InputError: The rulebook uses one of these parameters with another meaning.
        """
        directness = number_of(values, "verbal_directness") if values else None
        hinted = directness is not None and directness < IMPLICIT
        people = (person,) if values else ()
        return self._said("hint_at_passing" if hinted else "ask_to_pass", people, values)

    def language_of(self, values: Inference | None) -> str:
        """Language for a person, by its code in the phrasebook.

        Raises:
            InputError: There are no wordings in the language of the parameter `greeting_language`.
        """
        if values is None or GREETING_LANGUAGE not in values.parameters:
            return self.site
        said = values[GREETING_LANGUAGE]
        if str(said.value) not in self.phrasebook:
            raise InputError(
                expected=f"greeting_language as one that the robot speaks ({', '.join(self.phrasebook)})",
                got=repr(said.value),
                remedy=closest(str(said.value), self.phrasebook.codes),
            )
        return self.site if said.origin == "neutral" else str(said.value)

    def wordings_of(self, values: Inference, person: str = "") -> tuple[Wording, ...]:
        """All wordings that a person with such parameters may hear, without duplicates."""
        said = (
            self.greeting((person,), values),
            self.handing_over(person, "", values),
            self.farewell(person, values),
            self.request_to_pass(person, values),
        )
        return tuple(dict.fromkeys(one for utterance in said for one in utterance.wordings))

    def _said(
        self, use: Use, people: Sequence[str], values: Inference | None, *, besides: Sequence[Use] = ()
    ) -> Utterance:
        language, register = self.phrasebook[self.language_of(values)], _register(values)
        first_meeting = values is not None and values.inputs.get("familiarity") == "stranger"
        found = [language.find(one, register, first_meeting=first_meeting) for one in (use, *besides)]
        said = [one for one in found if one and (one.is_reviewed or not self.reviewed_only)]
        if not said or said[0] is not found[0]:
            language, register = self.phrasebook[self.site], "plain"
            said = [language.plain(use)]
        called = tuple(Called(person, self.addresses.get(person)) for person in people)
        return Utterance(tuple(said), called, language.name_form(register), language.joined)


def number_of(values: Inference, parameter: str) -> float | None:
    """A numeric parameter of speech; None if the rulebook does not have it.

    Raises:
        InputError: It is not numeric.
    """
    if parameter not in values.parameters:
        return None
    value = values[parameter].value
    if isinstance(value, str):
        raise InputError(
            expected=f"{parameter} as a number",
            got=repr(value),
            remedy="The robot's words follow it; give the rulebook's another name, or this meaning.",
        )
    return value


def _register(values: Inference | None) -> Register:
    """The register by formality; neutral if the rulebook has no such parameter."""
    formality = number_of(values, "formality") if values else None
    if formality is None or INFORMAL <= formality <= FORMAL:
        return "neutral"
    return "informal" if formality < INFORMAL else "formal"


def _style(values: Inference) -> tuple[Use, ...]:
    style = number_of(values, "rhetorical_style")
    return ("honour",) if style is not None and style > RHETORICAL else ()


def _help(values: Inference) -> tuple[Use, ...]:
    directness = number_of(values, "verbal_directness")
    if directness is None or IMPLICIT <= directness <= EXPLICIT:
        return ()
    return ("hint_at_help",) if directness < IMPLICIT else ("offer_help",)


SPEAKER = Speaker()
"""A speaker with the shipped wordings at an English-speaking site."""
