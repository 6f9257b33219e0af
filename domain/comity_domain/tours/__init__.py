"""A plan as a tour: its exact cost and times, its quick cost, and lower bounds."""
