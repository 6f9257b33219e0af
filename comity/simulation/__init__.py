"""A scenario in the 2D world: the place, who stands where, and the changes and faults that happen there."""
