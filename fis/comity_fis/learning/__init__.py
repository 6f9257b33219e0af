"""What people teach: one by signals of discomfort, many by a table from which rules and priors are learnt."""
