"""Golden episodes: their location, the inputs of a case, edits of these, and differences now."""
