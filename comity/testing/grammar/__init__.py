"""The language of expectations: its words, units, the sentence, and how YAML needs it quoted."""
