"""Episodes in words and pictures: the account, the trace and its reasons, figures, where two runs part."""
