"""The label search, exact with priorities and deadlines: order, dropped visits, feasibility of deadlines."""
