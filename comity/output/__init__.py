"""Output files: the run, the resolved scenario, PDDL, rulebooks."""
