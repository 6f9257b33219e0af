"""What users specify besides people: goals, changes, faults, walks, tests, and consistency checks."""
