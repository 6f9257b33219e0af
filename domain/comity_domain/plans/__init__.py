"""The answer: a plan, the same as JSON, its remaining goals, and choices no longer permitted."""
