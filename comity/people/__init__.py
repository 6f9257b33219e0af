"""Who a person is: dated facts, languages, cultures, the declared profile, what is kept and was learnt."""
