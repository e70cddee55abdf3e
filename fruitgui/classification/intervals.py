"""How sure a rate is that was counted on a few fruit."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Rate:
    """A share of `trials`, with the interval that holds the true share.

    Attributes:
        value: successes / trials; NaN without trials.
        low: lower end of the interval, 0–1.
        high: upper end of the interval, 0–1.
        trials: how many were counted.
    """

    value: float
    low: float
    high: float
    trials: int


def rate(successes: int, trials: int, confidence: float = 0.95) -> Rate:
    """Return the share with its exact interval (Clopper & Pearson 1934), which never promises too much.

    Raises:
        ValueError: not 0 ≤ successes ≤ trials, or confidence outside (0, 1).
    """
    if not 0 <= successes <= trials or not 0.0 < confidence < 1.0:
        raise ValueError(f"no rate of {successes} in {trials} at confidence {confidence}")
    if trials == 0:
        return Rate(float("nan"), 0.0, 1.0, 0)
    from scipy.special import betaincinv

    tail = (1.0 - confidence) / 2.0
    failures = trials - successes
    low = 0.0 if successes == 0 else float(betaincinv(successes, failures + 1, tail))
    high = 1.0 if failures == 0 else float(betaincinv(successes + 1, failures, 1.0 - tail))
    return Rate(successes / trials, low, high, trials)
