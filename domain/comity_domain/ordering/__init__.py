"""The best order of visits, found while measuring paths; insertion and local search for many people."""
