"""Classical planning: the request in the words of PDDL, and Fast Downward run on it."""
