"""How files and folders of scenario tests are called. It imports nothing: pytest loads it in any project."""

SUFFIX = ".scenario.yaml"
GOLDEN = ".golden"
