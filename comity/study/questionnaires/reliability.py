"""Cronbach's alpha of a subscale, with a bootstrap interval over participants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from comity.study.report.resampling import AT_ONCE, LEVEL, RESAMPLES, SEED, Floats, Labels, numbered


@dataclass(frozen=True, slots=True)
class Reliability:
    """Internal consistency of a subscale."""

    alpha: float | None
    """Cronbach's alpha; None for a single item, or if all complete sheets have the same sum."""
    low: float | None
    """Lower end of the interval; None for fewer than two participants."""
    high: float | None
    sheets: int
    """Number of complete sheets; only these count."""
    participants: int
    """Number of participants with such sheets."""


def reliability_of(answers: Floats, participants: Labels) -> Reliability:
    """Alpha = k / (k - 1) * (1 - sum of the items' variances / variance of their sum).

    Cronbach, "Coefficient alpha and the internal structure of tests", Psychometrika 16(3), 1951. The
    bootstrap resamples participants with all their sheets, since one person's sheets are correlated; the
    interval is the middle 95 % of 2,000 resamples.

    Args:
        answers: Array (sheets, items), NaN for missing answers.
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
    """Alpha of several resamples, shape (resamples,); NaN if undefined.

    Args:
        block: Array (sheets, items), without NaN.
        times: Array (resamples, sheets): weight of each sheet.
    """
    sheets, items = block.shape
    if items < 2 or sheets < 2:
        return np.full(len(times), np.nan)
    shares = times / times.sum(axis=1, keepdims=True)
    off = block - block.mean(axis=0)  # centred, so that squares lose no digits
    with_sum = np.column_stack([off, off.sum(axis=1)])
    variances = shares @ with_sum**2 - (shares @ with_sum) ** 2
    total = np.where(variances[:, -1] > 1e-12, variances[:, -1], np.nan)  # NaN: all sums are the same
    return np.asarray(items / (items - 1) * (1 - variances[:, :-1].sum(axis=1) / total))
