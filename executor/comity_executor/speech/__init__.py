"""What the robot says and in which manner: words by formality and language, loudness, pace, gestures."""
