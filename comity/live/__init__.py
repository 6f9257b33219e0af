"""Real robots in place of the simulated one: their requirements on a map, and episodes in real time."""
