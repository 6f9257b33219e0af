"""Explanations of a tour's steps: reasons, obstacles to alternatives, and what would change the choice."""
