"""Facts that follow from a culture, and several cultures in one person."""
