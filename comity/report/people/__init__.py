"""One person over time: what is known of them, visits to them, one life, the answer to a question."""
