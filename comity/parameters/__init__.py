"""From what people declared to the parameters of actions: own words, wishes, consent, earlier meetings."""
