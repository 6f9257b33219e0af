"""The fields to report of a study with people: what is known filled in, the rest left blank."""
