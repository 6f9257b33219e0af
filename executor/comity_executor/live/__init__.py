"""Robots in real time: a loop, the stop in a thread of its own, and a base that never goes on alone."""
