"""A bound problem solved by whichever engine can, with the reason of every step or what is in the way."""
