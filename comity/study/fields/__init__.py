"""The fields to report of a study, with people or simulated: what is known filled in, the rest left blank."""
