"""Acts of the robot towards people: speech, gestures and handling, which take time and are recorded."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol, runtime_checkable

from comity_fis.errors import WrongValueError
from comity_sim2d.clock import Clock
from comity_sim2d.kinds import TRUTH, require_kinds, require_numbers
from comity_sim2d.scene_error import require_text, shown

PICK_UP, HAND_OVER = "pick_up", "hand_over"
ASK_TO_PASS = "ask_to_pass"
GESTURE_S = 1.5
HANDLING_S = 2.5
"""Duration of picking something up, and of handing it over [s] (our choice: hands and arms are not
simulated)."""
SPEECH_S = 2.0
"""Duration of an utterance whose text is not known [s]."""
SPEECH_S_PER_CHARACTER = 0.06
"""Duration of speech per character [s]: about 170 words a minute, calm English speech."""
SHORTEST_SPEECH_S = 1.0


VERBS = {
    "wave": "waves",
    "nod": "nods",
    "bow": "bows",
    "bow_and_nod": "bows and nods",
    "handshake": "shakes hands",
    "palms_together": "joins palms",
    PICK_UP: "picks up",
    HAND_OVER: "hands over",
}
"""Gestures of the shipped rulebooks, as verbs in a sentence."""


_NAME = "act "
"""Prefix of act identifiers, before their number in the record: the first one is `act 1`."""

SMALL, LARGE = 0.35, 0.65
"""Volume and amplitude below `SMALL` or above `LARGE`, in [0, 1], are mentioned in words (our choice)."""


@runtime_checkable
class ActManner(Protocol):
    """The manner of an act."""

    @property
    def volume(self) -> float:
        """Volume of the voice, as a share of the loudspeaker's range, in [0, 1]."""
        ...

    @property
    def rate(self) -> float:
        """Speech rate, as a multiple of the normal rate, above 0."""
        ...

    @property
    def amplitude(self) -> float:
        """Amplitude of a gesture, as a share of the largest one, in [0, 1]."""
        ...


@dataclass(frozen=True, slots=True)
class Normal:
    """The manner towards a person without known facts."""

    volume: float = 0.5
    rate: float = 1.0
    amplitude: float = 0.5


NORMAL = Normal()


@runtime_checkable
class Spoken(Protocol):
    """The wordings of an utterance; the executor's have this form."""

    @property
    def text(self) -> str:
        """The text in the script of its language."""
        ...

    @property
    def latin(self) -> str:
        """The text in Latin letters."""
        ...

    @property
    def spoken(self) -> str:
        """The text for a speech synthesiser."""
        ...


@dataclass(frozen=True, slots=True)
class ActEvent:
    """One utterance or gesture."""

    t_start: float
    t_end: float
    """Time of its end or interruption [s]."""
    act: str
    """`say`, another act of speech such as `ask_to_pass`, a gesture's name, `pick_up` or `hand_over`."""
    person: str
    """The addressee; for `pick_up` the place."""
    text: str | None = None
    stopped: bool = False
    """Whether it was interrupted."""
    volume: float | None = None
    """Volume of an utterance, in [0, 1]."""
    rate: float | None = None
    """Speech rate, as a multiple of the normal rate."""
    amplitude: float | None = None
    """Amplitude of a gesture, in [0, 1]."""
    thing: str | None = None
    """The object picked up or handed over."""
    latin: str | None = None
    """The text in Latin letters, if written in another script."""
    utterance: Spoken | None = None
    """The wordings of the text, for the program that commanded it."""

    def __post_init__(self) -> None:
        require_text("act", "act", self.act)
        require_text(self.act, "person", self.person)
        require_numbers(self.act, t_start=self.t_start, t_end=self.t_end)
        require_numbers(self.act, volume=self.volume, rate=self.rate, amplitude=self.amplitude)
        texts = {name: (getattr(self, name), str | None) for name in ("text", "thing", "latin")}
        made_of = (self.utterance, Spoken | None)
        require_kinds(self.act, stopped=(self.stopped, TRUTH), utterance=made_of, **texts)

    @property
    def words(self) -> str:
        """The act in words: the utterance in quotation marks, or the gesture as a verb, and the manner."""
        if is_spoken(self.act, self.text):
            said = f"“{self.latin or self.text}”" if self.text else "speaks"
            return f"{said}{_adverb(self.volume, ' softly', ' loudly')}"
        done = VERBS.get(self.act, self.act.replace("_", " "))
        if self.thing is not None:
            return f"{done} {self.thing}"
        return f"{done}{_adverb(self.amplitude, ' slightly', ' widely')}"


@runtime_checkable
class ActRequest(Protocol):
    """A request to speak, gesture, pick up or hand over; the executor's have this form."""

    @property
    def act(self) -> str:
        """`say`, `ask_to_pass`, `pick_up`, `hand_over`, or a gesture's name."""
        ...

    @property
    def to(self) -> str:
        """The addressee; for `pick_up`, the place."""
        ...

    @property
    def text(self) -> str | None:
        """The text to say."""
        ...

    @property
    def thing(self) -> str | None:
        """The object to pick up or hand over."""
        ...

    @property
    def manner(self) -> ActManner:
        """The manner."""
        ...

    @property
    def latin(self) -> str | None:
        """The text in Latin letters: its length determines the duration."""
        ...

    @property
    def utterance(self) -> Spoken | None:
        """The wordings of the text; recorded as they are."""
        ...


class ActProgress(NamedTuple):
    """The progress of an act."""

    goal: str
    """Identifier of the act."""
    state: str
    """`running`, `succeeded` or `stopped`."""
    text: str = ""


class Acts:
    """The record of all acts, and which of them run."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._events: list[ActEvent] = []

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """All acts in the order they began."""
        return tuple(self._events)

    def start(self, goal: ActRequest) -> str:
        """Start an act, replacing the same one towards that person if it runs; returns its identifier."""
        act, person, text, manner, thing = goal.act, goal.to, goal.text, goal.manner, goal.thing
        latin = None if goal.latin == text else goal.latin
        texts = {name: (getattr(goal, name), str | None) for name in ("text", "latin")}
        require_kinds("act", act=(act, str), manner=(manner, ActManner), **texts)
        now = self._clock.now_s
        spoken = is_spoken(act, text)
        event = ActEvent(
            t_start=now,
            t_end=now + duration_s(act, latin or text, manner.rate),
            act=act,
            person=person,
            text=text,
            volume=manner.volume if spoken else None,
            rate=manner.rate if spoken else None,
            amplitude=None if spoken or thing is not None else manner.amplitude,
            thing=thing,
            latin=latin,
            utterance=goal.utterance,
        )
        for i, other in enumerate(self._events):
            if (other.act, other.person) == (act, person):
                self._break_off(i)
        self._events.append(event)
        return f"{_NAME}{len(self._events)}"

    def status(self, act: int | str) -> ActProgress:
        """The progress of an act.

        Raises:
            WrongValueError: There is no such act.
        """
        i = self._place(act)
        state = "stopped" if self._events[i].stopped else "running" if self._runs(i) else "succeeded"
        return ActProgress(f"{_NAME}{i + 1}", state)

    def ended(self, act: str, step_s: float) -> list[ActEvent]:
        """Acts of one kind that ended within the last tick of length `step_s` [s]."""
        now_s = self._clock.now_s + 1e-9
        return [
            event
            for event in self._events
            if event.act == act and now_s - step_s < event.t_end <= now_s and not event.stopped
        ]

    def fall_silent(self) -> None:
        """Interrupt all speech."""
        for i, event in enumerate(self._events):
            if is_spoken(event.act, event.text):
                self._break_off(i)

    def stop(self, act: str) -> None:
        """Interrupt an act, if it runs.

        Raises:
            WrongValueError: There is no such act.
        """
        self._break_off(self._place(act))

    def _runs(self, i: int) -> bool:
        return not self._events[i].stopped and self._clock.now_s < self._events[i].t_end - 1e-9

    def _break_off(self, i: int) -> None:
        if self._runs(i):
            self._events[i] = replace(self._events[i], t_end=self._clock.now_s, stopped=True)

    def _place(self, act: int | str) -> int:
        number = act.removeprefix(_NAME) if isinstance(act, str) else ""
        if not (number.isdecimal() and 1 <= int(number) <= len(self._events)):
            raise WrongValueError(
                expected=f"as goal an act that has begun, {_NAME}1 to {_NAME}{len(self._events)}",
                got=shown(act),
                remedy="Give what perform has returned.",
            )
        return int(number) - 1


def is_spoken(act: str, text: str | None) -> bool:
    """Whether an act is speech: gestures have no text."""
    return act == "say" or text is not None


def duration_s(act: str, text: str | None, rate: float = 1.0) -> float:
    """Duration of an act [s]; speech at half the rate takes twice as long."""
    if not is_spoken(act, text):
        return HANDLING_S if act in (PICK_UP, HAND_OVER) else GESTURE_S
    normal_s = SPEECH_S if text is None else max(SHORTEST_SPEECH_S, SPEECH_S_PER_CHARACTER * len(text))
    return normal_s / rate


def _adverb(value: float | None, small: str, large: str) -> str:
    if value is None:
        return ""
    return small if value < SMALL else large if value > LARGE else ""
