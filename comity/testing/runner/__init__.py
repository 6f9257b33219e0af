"""Many tests carried out: processes, what passed before, results, failures as people read them, pictures."""
