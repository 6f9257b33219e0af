"""One person's parameters: facts in, rules fired, values with their origins out."""
