"""What the tests share: the files of the page about custom domains, so that the page is what is tested."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PAGE_FILE = Path(__file__).parents[2] / "docs" / "how-to" / "use-a-custom-domain.md"
PAGE = dict(re.findall(r"^```\w+ (\S+)\n(.*?)^```$", PAGE_FILE.read_text("utf-8"), re.MULTILINE | re.DOTALL))
"""The waiter and the museum guide: texts of files, by name."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The files of the page in the current folder."""
    monkeypatch.chdir(tmp_path)
    for name, text in PAGE.items():
        Path(name).write_text(text)
    return tmp_path
