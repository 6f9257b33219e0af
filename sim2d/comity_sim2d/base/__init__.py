"""The moving base: two kinds of drive, their limits, and the bodies in pymunk."""
