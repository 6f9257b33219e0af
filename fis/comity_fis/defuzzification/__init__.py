"""The set that rules give together, its desirability curve, and the one number that stands for it."""
