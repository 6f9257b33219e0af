"""What trees are made of: leaves, decorators and limits, the tick, and the cause that a result carries."""
