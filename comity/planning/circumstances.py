"""The circumstances of a greeting in a scenario: full hands, noise, missing consent."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from comity.parameters.consent import asked_for_no_touch, gestures_of_contact, wishes_at_rest
from comity.parameters.perception import hears, lacks_hearing, lacks_sight, sees
from comity_domain import REACH_M, Circumstances
from comity_fis import Choice, unknown_word

if TYPE_CHECKING:
    from datetime import date

    from comity.people.profile import Profile
    from comity.scenario import Scenario, ScenarioFile
    from comity_fis import Inference, Rulebook


def circumstances(
    scenario: Scenario,
    name: str,
    values: Inference,
    rulebook: Rulebook,
    *,
    profile: Profile,
    day: date | None,
) -> Circumstances:
    """How things stand around one person; what is said of them goes before what is said of the place.

    Args:
        scenario: With the place, and what robot and person carry.
        name: The person.
        values: Their parameters.
        rulebook: The rules that gave them.
        profile: What they declared.
        day: On which dated facts are taken.
    """
    person, place = scenario.people[name], scenario.place
    return Circumstances(
        robot_carries=scenario.robot.carrying,
        person_carries=person.carrying,
        noise_db=place.noise_db if person.noise_db is None else person.noise_db,
        noisy=place.noisy if person.noisy is None else person.noisy,
        withheld=_withheld(values, rulebook),
        wants_no_touch=asked_for_no_touch(values),
        at_rest=wishes_at_rest(values),
        reach_m=scenario.robot.gesture_reach_m,
        touches=gestures_of_contact(rulebook),
        hears=hears(profile, day, person.situation) and not lacks_hearing(values),
        sees=sees(profile, day, person.situation) and not lacks_sight(values),
    )


def _withheld(values: Inference, rulebook: Rulebook) -> Mapping[str, str]:
    """The gestures that need something which is not so or not known, with what they need."""
    categories = getattr(rulebook.parameters.get("greeting_gesture"), "categories", ())
    gesture = values.parameters.get("greeting_gesture")
    if gesture is None or gesture.origin == "setting" or not isinstance(gesture.desirability, Choice):
        return {}
    permitted = gesture.desirability.memberships
    return {
        category.name: str(category.requires)
        for category in categories
        if category.requires is not None and category.name not in permitted
    }


def require_gestures(file: ScenarioFile, rulebook: Rulebook) -> None:
    """Refuse the reach of a gesture that neither the rulebook nor Comity knows: most likely a slip.

    Raises:
        InputError: with its line.
    """
    own = getattr(rulebook.parameters.get("greeting_gesture"), "categories", ())
    known = sorted({*REACH_M, *(one.name for one in own)})
    for gesture in file.scenario.robot.gesture_reach_m if not file.real_robot else ():
        if gesture not in known:
            raise unknown_word(
                f"a gesture of the rulebook {rulebook.name}, or one that Comity knows",
                gesture,
                known,
                where=file.where("robot", "gesture_reach_m", gesture),
            )
