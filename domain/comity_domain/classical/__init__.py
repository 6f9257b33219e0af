"""Classical planning: a request as a unified-planning problem and as PDDL, and plans in these terms."""
