"""Words that several answers have."""

from __future__ import annotations

from typing import Literal

Outcome = Literal["success", "partial", "failed", "stopped", "stop_unconfirmed"]
