"""What the nodes of one person's branch share: the meeting, the visit, its agenda, how far it is."""
