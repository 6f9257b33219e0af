"""Bindings: their content, the check of their names, and the people whose parameters they use."""
