"""A plan as a tour: its exact cost and times, its cost at a glance, and what none can cost less than."""
