"""Explains inferred values: contributions of rules, sensitivities, and counterfactuals."""
