"""Reads and validates files; errors say where, what was expected, and what to do."""
