"""What may be passed on of people: pseudonyms, age bands, relative times and no free text, by one filter."""
