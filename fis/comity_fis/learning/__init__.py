"""Learning: from one person's signals of discomfort, and from tables of many people (rules and priors)."""
