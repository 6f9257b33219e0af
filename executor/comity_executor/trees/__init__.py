"""From a plan to a behaviour tree and its subtrees, and the same as BehaviorTree.CPP XML."""
