"""What a tree needs of a robot: the protocol, its readings, what it notices."""
