"""People: dated facts, languages, cultures, the declared profile, stored and learnt data."""
