"""Generic people: a representative side and greeting, so that preferences have no influence."""

from comity_domain.choices.greeting import NO_GESTURE, Greeting
from comity_domain.choices.side import Side

ANY_SIDE = Side("front", 0.0, 1.0, inferred=True)
ANY_GREETING = Greeting("any", NO_GESTURE, 1.0, 0)
