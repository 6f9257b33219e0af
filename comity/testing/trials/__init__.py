"""One case of a scenario's matrix, its profiles, world and day; the case carried out, and orders kept."""
