"""A scene: the room, what and who stands in it; frozen, and checked when built."""
