"""The parameters of a person that Comity's own actions read, by what reads them."""

from __future__ import annotations

DISTANCE, SPEED, GREETING_LANGUAGE = "conversational_distance", "approach_speed", "greeting_language"
BEARING = "approach_bearing"
"""No parameter of a person, but of a step: where the robot stands, as the planner chose it [deg]."""
ABOUT_VISITS = (DISTANCE, "approach_direction", SPEED, "greeting_modality", "greeting_gesture")
"""What reaching and greeting a person binds; a rulebook for visits has all of them."""
ABOUT_WORDS = (GREETING_LANGUAGE, "formality", "rhetorical_style", "verbal_directness")
"""What chooses the words of an utterance."""
ABOUT_SPEECH = ("voice_volume", "speech_rate")
ABOUT_GESTURES = ("gesture_amplitude",)
BOUND = frozenset((*ABOUT_VISITS, GREETING_LANGUAGE, *ABOUT_SPEECH, *ABOUT_GESTURES))
"""What the arguments of goals and acts are made of: pose, speed, act, language and manner."""
