"""Classical planning: the request as a unified-planning problem and as PDDL, and plans in its words."""
