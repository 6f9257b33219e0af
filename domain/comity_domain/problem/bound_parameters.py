"""Parameters of a person that Comity's own actions read, by their use."""

from __future__ import annotations

DISTANCE, SPEED, GREETING_LANGUAGE = "conversational_distance", "approach_speed", "greeting_language"
BEARING = "approach_bearing"
"""A parameter of a step, not of a person: the robot's direction from the person, as planned [deg]."""
ABOUT_VISITS = (DISTANCE, "approach_direction", SPEED, "greeting_modality", "greeting_gesture")
"""Parameters bound by reaching and greeting a person; a rulebook for visits has all of them."""
ABOUT_WORDS = (GREETING_LANGUAGE, "formality", "rhetorical_style", "verbal_directness")
"""Parameters that select the wording of an utterance."""
ABOUT_SPEECH = ("voice_volume", "speech_rate")
ABOUT_GESTURES = ("gesture_amplitude",)
BOUND = frozenset((*ABOUT_VISITS, GREETING_LANGUAGE, *ABOUT_SPEECH, *ABOUT_GESTURES))
"""Parameters that determine goals and acts: pose, speed, act, language and manner."""
