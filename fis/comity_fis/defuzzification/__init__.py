"""Defuzzification: the aggregated output set, its desirability curve, and the resulting number."""
