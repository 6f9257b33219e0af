"""Adaptation to one person: asking and editing, learning, changes over years, back to the rules."""
