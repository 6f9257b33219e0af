"""Countries, and tables that give them a score, such as Hofstede's individualism."""
