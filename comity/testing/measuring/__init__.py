"""What an episode amounts to, limits that it passed, and the profiles of a scenario compared."""
