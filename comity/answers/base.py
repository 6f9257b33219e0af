"""What every answer has."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

Outcome = Literal["success", "partial", "failed", "stopped", "stop_unconfirmed"]


Halt = Literal["preempted", "timed_out", "achieved_early", "parent_ended", "emergency"]


class Answer(BaseModel):
    """The base of all answers: frozen, and no key that is not declared here.

    Validators are built at first use: a command gives one or two of a hundred answers.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)
