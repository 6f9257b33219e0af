"""What every table and page of a study says about its differences between people."""

STATEMENT = (
    "Simulated people: differences between profiles are assumptions of the population and the rulebook, "
    "no findings about people."
)
