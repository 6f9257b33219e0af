"""What every action costs: by the domain itself, and by how much people like it."""
