"""The result of planning: a plan, its JSON form, its remaining goals, and choices no longer permitted."""
