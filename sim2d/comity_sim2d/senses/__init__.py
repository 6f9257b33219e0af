"""What the robot knows about people: detection, tracking, missing people, sensor delay."""
