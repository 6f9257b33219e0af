"""What became of the plan and of the doors is kept in the account of a run, also of one cut short."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from comity.answers.run import RunAnswer
from comity.live_episode import LiveEpisode
from comity.output.run_folder import RunFolder
from comity.preparation import prepare
from comity.report.episodes.run import account_before, account_under_way
from comity.scenario import load_scenario
from comity.schedule import Stage
from comity_fis.record import as_text, reader

OFFICE = """
schema_version: 1
name: office
place: {map: office, doors: {meeting room: open}}
robot: {at: entrance}
people:
  guest: {at: presenter}
  clerk: {at: desk 4}
goals:
  - greet: guest
  - greet: clerk
"""


@dataclass(frozen=True)
class DoorShuts:
    """The door of the meeting room is shut for two seconds."""

    at_s: float = 2.0

    def happen(self, stage: Stage) -> Iterator[None]:
        stage.world.set_door("meeting room", open=False)
        while stage.world.time_s < self.at_s + 2.0:
            yield
        stage.world.set_door("meeting room", open=True)


def test_doors_and_plans_stand_in_the_account_while_the_run_goes_on(tmp_path):
    (tmp_path / "office.scenario.yaml").write_text(OFFICE)
    prepared = prepare(load_scenario(str(tmp_path / "office.scenario.yaml")))
    live = LiveEpisode(prepared, happenings=[DoorShuts()])
    live.run()
    account = account_under_way(account_before(prepared, RunFolder(tmp_path), 0), live)
    turns = [(round(turn.t, 2), turn.door, turn.open) for turn in account.doors]
    assert turns == [(2.0, "meeting room", False), (4.0, "meeting room", True)]
    told = [(one.t, one.kind) for one in account.revisions]
    kinds = ("rebound", "replanned", "not_replanned")
    assert told == [(event.t, event.status) for event in live.events if event.status in kinds]
    plans = [one.steps for one in account.revisions if one.kind != "not_replanned"]
    assert [[step.action for step in steps] for steps in plans] == [
        [step.action for step in revision.plan.steps] for revision in live.revisions
    ]
    assert plans
    assert reader(RunAnswer).validate_json(as_text(account)) == account
