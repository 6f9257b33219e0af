"""Output files for later and for other programs: the run, the scenario as it was run, PDDL, a rulebook."""
