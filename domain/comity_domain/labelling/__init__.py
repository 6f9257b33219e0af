"""The label search, exact with priorities and deadlines: which order, who is left out, who is met in time."""
