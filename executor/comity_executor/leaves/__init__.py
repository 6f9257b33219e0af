"""The conditions and actions of a visit: navigate, dock, face, attend, greet, serve the agenda, give up."""
