"""Robots in real time: a loop, the stop that is read beside it, and a base that never goes on alone."""
