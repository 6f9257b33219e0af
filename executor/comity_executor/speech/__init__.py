"""Speech and manner: wordings by formality and language, volume, rate, gestures."""
