"""Solves a bound problem with a suitable engine; explains each step, or why there is no plan."""
