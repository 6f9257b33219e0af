"""Tables: CSV with lines in complaints, measured tuples, variables fitted to them, rulebooks held to them."""
