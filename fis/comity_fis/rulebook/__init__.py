"""Rulebooks of variables, parameters and rules: inference for one person or many, and YAML files."""
