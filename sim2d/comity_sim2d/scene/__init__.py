"""A scene: a room with its things and people, and the robot at its start; frozen, and checked when built."""
