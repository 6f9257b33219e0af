"""Plans in a domain of the user's own, in words: the plan, one step, its stability, what others change."""
