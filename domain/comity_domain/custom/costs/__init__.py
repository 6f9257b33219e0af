"""Cost of every action: the domain's own cost plus preference costs."""
