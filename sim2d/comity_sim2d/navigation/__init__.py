"""Where the robot may stand next to a person, and by which route it gets there."""
