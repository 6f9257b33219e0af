"""Anybody: a side and a greeting that stand for all of them, where taste has no say."""

from comity_domain.choices.greeting import NO_GESTURE, Greeting
from comity_domain.choices.side import Side

ANY_SIDE = Side("front", 0.0, 1.0, inferred=True)
ANY_GREETING = Greeting("any", NO_GESTURE, 1.0, 0)
