"""A binding: what it says, whether it names what there is, and whose parameters are meant."""
