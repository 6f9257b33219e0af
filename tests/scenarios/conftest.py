"""`test_scenarios.py` tries these files and the shipped ones; `comity test tests/scenarios` these alone."""

collect_ignore_glob = ["*.scenario.yaml"]
