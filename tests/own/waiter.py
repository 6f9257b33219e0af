"""The waiter of docs/how-to/use-your-own-domain.md, taken from the page, so that the page is what is tested."""

from __future__ import annotations

import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "use-your-own-domain.md"


def files_of_the_page() -> dict[str, str]:
    """Every fenced block of the page that has a file name."""
    text = PAGE.read_text(encoding="utf-8")
    return dict(re.findall(r"^```\w+ (\S+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
