"""What is answered: a plan, the same as JSON, what is left of it, and what of it is permitted no more."""
