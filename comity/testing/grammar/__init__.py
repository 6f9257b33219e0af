"""The language of expectations: its words, units and grammar, and quoting in YAML."""
