"""Plans in words: steps, reasons, alternative costs, and the effect of other profiles."""
