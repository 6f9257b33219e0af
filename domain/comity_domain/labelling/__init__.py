"""The label search, exact for priorities and deadlines: who is left out, who can be met in time."""
