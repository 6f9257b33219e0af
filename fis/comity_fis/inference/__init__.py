"""Parameters of one person or of columns of people: facts in, rules fired, values with their origins out."""
