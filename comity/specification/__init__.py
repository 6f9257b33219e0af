"""What a user writes beside the people: goals, changes, faults, walks, tests, and what must agree."""
