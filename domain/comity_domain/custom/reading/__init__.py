"""Reads PDDL files into a unified-planning problem; locates what its reader rejects or misreads."""
