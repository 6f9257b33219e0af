"""Rules as values, the language they are written in, their hedges, and the operators that evaluate them."""
