"""What the robot knows about people: seen, tracked, missing, and a little late."""
