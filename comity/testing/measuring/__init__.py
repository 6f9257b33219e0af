"""Metrics of an episode, violated safety limits, and the profiles of a scenario compared."""
