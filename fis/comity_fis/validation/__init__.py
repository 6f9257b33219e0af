"""Files in, checked values out; errors that say where, what was expected, and what to do."""
