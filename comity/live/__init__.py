"""A real robot in the place of the simulated one: what it needs of a map, and an episode in real time."""
