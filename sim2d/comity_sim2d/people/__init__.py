"""Pedestrians: the social forces between them, where they go, and how they react to the robot."""
