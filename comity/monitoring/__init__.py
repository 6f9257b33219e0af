"""A plan while it is carried out: what is news, what is left, whether it stands, a new one, the figures."""
