"""Rules: their data types, the rule language, hedges, and the operators that evaluate them."""
