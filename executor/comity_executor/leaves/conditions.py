"""The conditions of the tree; each checks the world or the visit's memory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from comity_executor.leaves.docking_band import DockingBand, enter_band, leave_band
from comity_executor.memory.visit_context import DONE, SAY_ACT, VisitContext
from comity_executor.nodes.cause import Account
from comity_executor.nodes.fault import SENSORS, trouble_of, trouble_with
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Condition, Ports
from comity_executor.robots.goals import RelativePose
from comity_executor.robots.robot import Reading
from comity_fis.listing import listed


class IsDocked(Condition):
    """`docked?`: does the robot rest at its pose, or has it stayed within the loose band since docking?"""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("docked?", meeting.person), meeting.reach_grounds)
        self._meeting = meeting = meeting.seen_by(
            self, reads=("reach", "values", "shown"), writes=("pose", "docked", "docked_at", "docked_s")
        )
        self._pose: RelativePose | None = None
        self._reading: Reading | None = None
        self._seen_s = 0.0
        self._enter: DockingBand
        self._leave: DockingBand
        self._band: DockingBand
        """The band that was last checked."""

    def check(self) -> bool:
        """Check the tight band until docked, the loose one from then on."""
        meeting, memory = self._meeting, self._meeting.memory
        if (pose := meeting.pose) is not self._pose:
            self._choose_bands(pose)
        self._band = self._leave if memory.docked else self._enter
        self._reading = meeting.senses.read(meeting.person)
        if self._reading is None:
            memory.docked = memory.docked and self._seen_lately()
        else:
            self._seen_s = meeting.senses.now_s()
            docked = self._band.contains(self._reading)
            if docked and not memory.docked:
                memory.pose, memory.docked_at, memory.docked_s = pose, self._reading, self._seen_s
            memory.docked = docked
        return memory.docked

    def explain(self) -> Account | None:
        """The quantity outside the band, or all of them if docked."""
        robot, person = self._meeting.robot, self._meeting.person
        if self._reading is None:
            return Account(f"{person} is not seen", fault=trouble_of(robot, SENSORS))
        if self._band is self._leave and (fault := trouble_with(robot, person)):
            return replace(self._band.account(self._reading), fault=fault)
        return self._band.account(self._reading)

    def _seen_lately(self) -> bool:
        return self._meeting.senses.now_s() - self._seen_s <= self._meeting.limits.unseen_s

    def _choose_bands(self, pose: RelativePose) -> None:
        limits = self._meeting.limits
        self._pose = pose
        self._enter, self._leave = enter_band(pose, limits), leave_band(pose, limits)


class IsGreeted(Condition):
    """`greeted?`: are all acts of the greeting done, and has the robot observed the reaction?"""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("greeted?", meeting.person), meeting.greet_grounds)
        self._meeting = meeting.seen_by(self, reads=("greet", "performed", "attended", "done_before"))
        self._acts = meeting.acts

    def check(self) -> bool:
        """Once true, it stays true."""
        return all(map(self._meeting.is_done, self._acts)) and self._meeting.is_attended

    def explain(self) -> Account | None:
        """The missing acts."""
        missing = [act for act in self._acts if not self._meeting.is_done(act)]
        if not missing and not self._meeting.is_attended:
            return Account(f"{self._meeting.person} has had no time to react", parameter="greeting_modality")
        text = f"{listed(missing)} not done yet" if missing else f"{listed(self._acts)} done"
        return Account(text, parameter="greeting_modality")


class IsActDone(Condition):
    """`done?`: was this act performed, so that a second docking does not repeat it?"""

    def __init__(self, meeting: VisitContext, act: str) -> None:
        super().__init__(NodeId.of("done?", act, meeting.person), meeting.greet_grounds)
        self._meeting = meeting.seen_by(self, reads=("greet", "performed", "done_before"))
        self._act = act

    @property
    def ports(self) -> Ports:
        """The act."""
        return {"act": self._act, "person": self._meeting.person}

    def check(self) -> bool:
        """Once true, it stays true."""
        return self._meeting.is_done(self._act)

    def explain(self) -> Account | None:
        """Whether it was performed."""
        text = f"{self._act} {'is done' if self._meeting.is_done(self._act) else 'not done yet'}"
        return Account(text, parameter="greeting_modality" if self._act == SAY_ACT else "greeting_gesture")


class IsGivenUp(Condition):
    """`given_up?`: did the visit fail for good, or did the person decline it?"""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("given_up?", meeting.person))
        self._meeting = meeting.seen_by(self, reads=("given_up", "declined", "failure", *DONE))

    @property
    def ports(self) -> Ports:
        """The person concerned."""
        return {"person": self._meeting.person}

    def check(self) -> bool:
        """True once the visit is given up; a new plan may try again."""
        return self._meeting.memory.is_over

    def explain(self) -> Account | None:
        """Why it was given up."""
        return Account(why) if (why := self._meeting.why) else None


class AreAllGreeted(Condition):
    """`all_greeted?`: the plan's goal, asked when every visit is over."""

    def __init__(self, meetings: Sequence[VisitContext], unserved: Mapping[str, str]) -> None:
        super().__init__("all_greeted?")
        self._meetings = [each.seen_by(self, reads=("given_up", "declined", "failure")) for each in meetings]
        self._unserved = unserved

    @property
    def ports(self) -> Ports:
        """All people to greet, as a BehaviorTree.CPP list."""
        return {"people": ";".join([*(meeting.person for meeting in self._meetings), *self._unserved])}

    def check(self) -> bool:
        """True if only people who declined were given up, and the plan could serve everyone."""
        return not self._given_up() and not self._unserved

    def explain(self) -> Account | None:
        """Who was not greeted, and why."""
        texts = [f"{meeting.person}: {meeting.memory.failure}" for meeting in self._given_up()]
        texts += [f"{person}: {reason}" for person, reason in self._unserved.items()]
        return Account("; ".join(texts)) if texts else None

    def _given_up(self) -> list[VisitContext]:
        visits = ((meeting, meeting.memory) for meeting in self._meetings)
        return [meeting for meeting, memory in visits if memory.given_up and memory.declined is None]
