"""The building blocks of trees: leaves, decorators, limits, and the causes of results."""
