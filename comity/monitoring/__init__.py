"""Monitoring of a plan's execution: world changes, remaining goals, validity, plan updates, metrics."""
