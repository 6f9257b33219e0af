"""Shortest and cheapest paths over a floor, on plain geometry."""
