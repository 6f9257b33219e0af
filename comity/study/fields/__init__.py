"""Reporting fields of a study, with people or simulated: known ones filled in, the rest left blank."""
