"""Numbers of a episode with units, and the causes behind each: course, places, distances, parameters."""
