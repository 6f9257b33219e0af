"""Data about people that may be passed on: pseudonyms, age bands, relative times, no free text."""
