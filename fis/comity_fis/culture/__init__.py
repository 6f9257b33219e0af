"""Countries, Hofstede's scores, and several cultures in one person."""
