"""Sessions with people: questions in order, and answers written to disk one by one."""
