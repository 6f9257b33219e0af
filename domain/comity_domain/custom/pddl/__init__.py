"""PDDL read with care: forms that remember where they stand, and a problem of unified-planning."""
