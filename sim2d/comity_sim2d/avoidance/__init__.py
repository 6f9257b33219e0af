"""What the robot does whatever it is told: slow down, stop, step aside, let people pass."""
