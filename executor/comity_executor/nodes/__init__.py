"""What trees are made of: leaves, decorators and limits, and the cause that a result carries."""
