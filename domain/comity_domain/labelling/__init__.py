"""The label search, exact with priorities and deadlines: the order, dropped visits, deadlines kept."""
