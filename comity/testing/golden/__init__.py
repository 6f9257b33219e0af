"""Golden episodes: where each is kept, what a case reads, what was edited, and what differs now."""
