"""Numbers of an episode with units, and the causes behind each: course, places, distances, parameters."""
