"""One file per command. What a command needs is imported when it runs, so that `comity --help` answers at once."""
