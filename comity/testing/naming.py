"""Names in files, folders and reports of scenario tests. It imports nothing: pytest loads it everywhere."""

SUFFIX = ".scenario.yaml"
GOLDEN = ".golden"
RESULT = "comity"
"""Attribute of a pytest report that holds the plugin's result of a test, as JSON."""
