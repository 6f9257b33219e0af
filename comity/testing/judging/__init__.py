"""A test judged: what it amounts to, profiles beside each other, what is forbidden, the verdict."""
