"""What is asked: people and agendas, the ways between them, what the moment rules out."""
