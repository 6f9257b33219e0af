"""Report of a study: intervals, differences, who is served worse, failures, and its page."""
