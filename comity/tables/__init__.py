"""Tables: CSV with line-numbered errors, measured tuples, variables and rules from data, evaluation."""
