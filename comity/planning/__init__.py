"""Planning requests, blocked routes, and why there may be no plan, or one for fewer people."""
