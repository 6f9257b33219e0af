"""Running tests: results, readable failures, pictures, and the call of pytest with its settings."""
