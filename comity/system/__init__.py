"""Access to the operating system: shipped and own files, private files, streams, signals, memory."""
