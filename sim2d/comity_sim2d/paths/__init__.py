"""Shortest and cheapest paths over a floor, from shapes alone."""
