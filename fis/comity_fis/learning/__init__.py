"""What meetings with one person teach: signals of discomfort, the comfortable interval, what was learnt."""
