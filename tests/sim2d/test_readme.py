"""The example in the README runs and prints what it says."""

import re
from pathlib import Path


def test_the_example_in_the_readme_prints_what_it_says(capsys) -> None:
    readme = Path(__file__).parents[2] / "sim2d" / "README.md"
    (code,) = re.findall(r"```python\n(.*?)```", readme.read_text(encoding="utf-8"), flags=re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})
    (said,) = re.findall(r"print\(.*\)  # (.*)", code)
    assert capsys.readouterr().out.strip() == said
