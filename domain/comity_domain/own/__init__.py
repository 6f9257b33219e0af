"""Planning in a domain of one's own: PDDL read with care, and costs that come from what people like."""
