"""Pseudonymised sharing of data about people: pseudonyms, age bands, relative times, no free text."""
