"""What the robot says to a person who does not see: that it comes, where it has stopped, that it leaves.

Our own texts, which no speaker has reviewed. As with greetings (`wording`), they follow the language, and
mention no gender or title. The name comes second, so that it can be left out (`without_names`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_executor.speech.wording import name_of, spoken_language
from comity_fis.inference.value import Inference

BESIDE_DEG, BEHIND_DEG = 30.0, 150.0
"""Up to the one the robot is in front, from the other on behind, in between left or right (our choice)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Announcements:
    """One language's."""

    coming: str
    stopped: str
    front: str
    left: str
    right: str
    behind: str
    leaving: str


ANNOUNCEMENTS: Mapping[str, Announcements] = {
    "eng": Announcements(
        coming="This is the robot, {name}. I am coming over to you.",
        stopped="I have stopped {where}.",
        front="in front of you",
        left="on your left",
        right="on your right",
        behind="behind you",
        leaving="I am leaving now.",
    ),
    "deu": Announcements(
        coming="Hier ist der Roboter, {name}. Ich komme jetzt näher.",
        stopped="Ich bin stehen geblieben: {where}.",
        front="vorn",
        left="links",
        right="rechts",
        behind="hinten",
        leaving="Ich fahre jetzt weg.",
    ),
    "swe": Announcements(
        coming="Det här är roboten, {name}. Jag kommer närmare nu.",
        stopped="Jag har stannat {where}.",
        front="framför dig",
        left="till vänster om dig",
        right="till höger om dig",
        behind="bakom dig",
        leaving="Jag åker i väg nu.",
    ),
    "ara": Announcements(
        coming="Ana ar-rubut, {name}. Ana qadim.",
        stopped="Tawaqqaftu {where}.",
        front="fi al-amam",
        left="ala al-yasar",
        right="ala al-yamin",
        behind="fi al-khalf",
        leaving="Ana dhahib al-an.",
    ),
    "jpn": Announcements(
        coming="Robotto desu, {name}-san. Ima sochira e mairimasu.",
        stopped="{where} ni tomarimashita.",
        front="Mae",
        left="Hidari",
        right="Migi",
        behind="Ushiro",
        leaving="Ima hanaremasu.",
    ),
}
"""By ISO 639-3 code, for the languages of `wording.PHRASES`."""


def coming_text(person: str, values: Inference) -> str:
    """What the robot says before it comes near."""
    return ANNOUNCEMENTS[spoken_language(values)].coming.format(name=name_of(person))


def stopped_text(bearing_deg: float, values: Inference) -> str:
    """What the robot says once it stands.

    Args:
        bearing_deg: Where it stands as the person sees it, in (-180, 180], positive to their left.
        values: The person's parameters.
    """
    words = ANNOUNCEMENTS[spoken_language(values)]
    if abs(bearing_deg) <= BESIDE_DEG:
        where = words.front
    elif abs(bearing_deg) >= BEHIND_DEG:
        where = words.behind
    else:
        where = words.left if bearing_deg > 0.0 else words.right
    return words.stopped.format(where=where)


def leaving_text(values: Inference) -> str:
    """What the robot says before it leaves."""
    return ANNOUNCEMENTS[spoken_language(values)].leaving
