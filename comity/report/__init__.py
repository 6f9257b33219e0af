"""What Comity says: one file per thing that can be told, as text for people and as answers for programs."""
