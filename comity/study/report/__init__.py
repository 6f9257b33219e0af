"""What a study that was run shows: intervals, differences, who is served worse, failures, and its page."""
