"""Cronbach's alpha of a subscale, with an interval that resamples participants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from comity.study.report.resampling import AT_ONCE, LEVEL, RESAMPLES, SEED, Floats, Labels, numbered


@dataclass(frozen=True, slots=True)
class Reliability:
    """How alike the items of a subscale are answered."""

    alpha: float | None
    """None for one item, or where all complete sheets have the same sum."""
    low: float | None
    """End of the interval; None for fewer than two participants."""
    high: float | None
    sheets: int
    """Without a missing answer; only these count."""
    participants: int
    """Whose sheets these are."""


def reliability_of(answers: Floats, participants: Labels) -> Reliability:
    """Alpha = k / (k - 1) * (1 - sum of the items' variances / variance of their sum).

    Cronbach, "Coefficient alpha and the internal structure of tests", Psychometrika 16(3), 1951. Participants
    are drawn again with replacement, each with all sheets, since one person's sheets resemble each other; the
    interval holds the middle 95 % of 2,000 resamples.

    Args:
        answers: Sheets x items, NaN where there is none.
        participants: The participant of each sheet.
    """
    complete = ~np.isnan(answers).any(axis=1)
    block = answers[complete]
    person, people = numbered(participants[complete])
    alpha = float(_alphas(block, np.ones((1, len(block))))[0])
    if np.isnan(alpha):
        return Reliability(None, None, None, len(block), people)
    low = high = None
    if people > 1:
        drawn = np.random.default_rng(SEED).multinomial(people, [1 / people] * people, size=RESAMPLES)
        parts = np.array_split(drawn, 1 + RESAMPLES * len(block) // AT_ONCE)
        alphas = np.concatenate([_alphas(block, part[:, person].astype(float)) for part in parts])
        low, high = map(float, np.nanquantile(alphas, [(1 - LEVEL) / 2, (1 + LEVEL) / 2]))
    return Reliability(alpha, low, high, len(block), people)


def _alphas(block: Floats, times: Floats) -> Floats:
    """Alpha of several resamples; NaN where it has no value.

    Args:
        block: Sheets x items, without NaN.
        times: Resamples x sheets: how often each sheet counts.
    """
    sheets, items = block.shape
    if items < 2 or sheets < 2:
        return np.full(len(times), np.nan)
    shares = times / times.sum(axis=1, keepdims=True)
    off = block - block.mean(axis=0)  # around the mean, so that squares lose no digits
    with_sum = np.column_stack([off, off.sum(axis=1)])
    variances = shares @ with_sum**2 - (shares @ with_sum) ** 2
    total = np.where(variances[:, -1] > 1e-12, variances[:, -1], np.nan)  # NaN: all sums are the same
    return np.asarray(items / (items - 1) * (1 - variances[:, :-1].sum(axis=1) / total))
