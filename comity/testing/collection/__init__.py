"""The paths that `comity test` gives to pytest, and the cases of a file with their expectations."""
