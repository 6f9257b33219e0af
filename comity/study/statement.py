"""The caveat that every table and page of a study states about its differences between people."""

STATEMENT = (
    "Simulated people: differences between profiles are assumptions of the population and the rulebook, "
    "no findings about people."
)
