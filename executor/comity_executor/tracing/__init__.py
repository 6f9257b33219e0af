"""The record of a run, written and read: events, node states, causes, switches, divergence of runs."""
