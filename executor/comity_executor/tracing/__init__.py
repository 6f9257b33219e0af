"""The record of a run, written and read: events, any node at any moment, causes, switches, divergence."""
