"""Custom-domain plans in words: the plan, one step, its stability, the effect of other profiles."""
