"""Explanations of a tour's steps: reasons, obstacles to other choices, and what would change them."""
