"""Names in files, folders and reports of scenario tests. It imports nothing: pytest loads it everywhere."""

SUFFIX = ".scenario.yaml"
GOLDEN = ".golden"
RESULT = "comity"
"""The attribute of a report of pytest that holds what our plugin says of a test, as JSON."""
