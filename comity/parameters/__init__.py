"""From declared profiles to parameters of actions: own words, settings, consent, earlier encounters."""
