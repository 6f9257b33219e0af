"""Digest of plain values, to detect changes."""

from __future__ import annotations

import json
from hashlib import sha256
from typing import Any


def digest_of(content: Any) -> str:
    """SHA-256 of plain values in hexadecimal, independent of the order of keys."""
    return sha256(json.dumps(content, sort_keys=True, default=str).encode()).hexdigest()
