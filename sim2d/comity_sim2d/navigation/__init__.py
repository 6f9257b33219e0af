"""Where the robot may stand beside somebody, and by which route it gets there."""
