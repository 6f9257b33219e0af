"""Sessions with people: what is asked in which order, and answers on disk one by one."""
