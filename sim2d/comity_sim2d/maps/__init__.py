"""Places drawn as maps: rooms, doors, and the files that describe them."""
