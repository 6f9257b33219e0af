"""One case of a scenario's matrix, its profiles, world and day; and its execution."""
