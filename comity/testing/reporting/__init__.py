"""Reports of many tests: as JSON, by profile, and differences that no parameter explains."""
