"""Classical planning: the request in the words of PDDL."""
