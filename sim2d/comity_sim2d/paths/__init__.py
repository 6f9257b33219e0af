"""Shortest and cheapest ways over a floor, from shapes alone."""
