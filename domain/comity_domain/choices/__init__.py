"""What can be chosen at each person, and its price: sides, greetings, greetings of a whole company, legs."""
