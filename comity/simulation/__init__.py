"""A scenario in the 2D world: its place, the poses of people, and changes and faults during the episode."""
