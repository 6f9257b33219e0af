"""Episodes in words and pictures: account, trace and causes, metrics, divergence of two runs."""
