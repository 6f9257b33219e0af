"""PDDL files as a problem of unified-planning: what its reader refuses or would misread, with a place."""
