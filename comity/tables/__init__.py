"""Tables: CSV with errors by line, measured tuples, variables and rules from them, rulebooks evaluated."""
