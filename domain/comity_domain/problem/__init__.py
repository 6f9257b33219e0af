"""The planning request: people and agendas, the paths between them, excluded choices."""
