"""What the planner is asked, what bars the ways, and why there may be no plan, or one for fewer people."""
