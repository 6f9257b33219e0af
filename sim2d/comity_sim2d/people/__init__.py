"""Everybody on foot: the social forces between them, where they go, and what they do about the robot."""
