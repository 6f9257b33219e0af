"""What leaves share, on py_trees' blackboard: the base, the visit, its agenda, requests for passage."""
