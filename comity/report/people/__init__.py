"""One person over time: stored data, visits, yearly changes, the answer to a question."""
