"""The choices for each person with their costs: sides, greetings, group greetings, legs."""
