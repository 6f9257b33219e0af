"""Which tests are meant: folders, paths, words of -k, and the cases of a file with what they have to hold."""
