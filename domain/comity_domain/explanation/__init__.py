"""Why each step of a tour is as it is, what stands in the way of others, and what would tip it."""
