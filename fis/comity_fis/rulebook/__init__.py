"""Rulebooks: variables, parameters and rules as one, answers for one person or many, and YAML files."""
