"""Safety behaviours that override every command: slow down, stop, step aside, let people pass."""
