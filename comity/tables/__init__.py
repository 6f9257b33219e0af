"""Tables: CSV with lines in complaints, measured tuples, variables and rules from them, rulebooks judged."""
