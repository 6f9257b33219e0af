"""Converts a plan to a behaviour tree with subtrees, and exports it as BehaviorTree.CPP XML."""
