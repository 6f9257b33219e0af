"""One person's values in words and pictures: inferred, explained, and the figures of the paper."""
