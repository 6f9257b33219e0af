"""The shape of every `--json` answer; `comity schema` prints these as JSON schemas."""
