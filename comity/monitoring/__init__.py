"""Monitoring of execution: world changes, remaining goals, plan validity, plan updates, metrics."""
