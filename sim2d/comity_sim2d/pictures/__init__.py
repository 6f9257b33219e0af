"""Pictures and animations of maps and episodes."""
