"""How the robot adapts to one person: asking and editing, learning, years together, back to the rules."""
