"""The best order of visits: all of them looked at, or insertion, and settled once ways are measured."""
