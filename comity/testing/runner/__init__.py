"""One test and its result, failures as people read them, pictures; the call of pytest with its settings."""
