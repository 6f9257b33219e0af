"""What Comity needs of the machine: shipped and own files, private files, streams, signals, memory."""
