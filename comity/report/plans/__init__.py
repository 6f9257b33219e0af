"""Plans in words: what the robot means to do, why so, what else would cost, what others change."""
