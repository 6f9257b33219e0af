"""Numbers of a trial with units, and the causes behind each: course, places, distances, parameters."""
