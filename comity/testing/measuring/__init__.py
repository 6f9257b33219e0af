"""Metrics of an episode, limits that it passed, and the profiles of a scenario compared."""
