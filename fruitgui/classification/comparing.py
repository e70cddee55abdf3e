"""Two models on the same fruit: which is better, and whether that can be told at all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

SURE = 0.05
"""A difference that chance would make less often than this is one."""


class Verdict(StrEnum):
    """What a comparison came to, for the first of the two."""

    BETTER = "better"
    WORSE = "worse"
    ALIKE = "alike"


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two models that judged the same fruit.

    Attributes:
        fruit: how many.
        right, other_right: of these, got right by either.
        only, only_other: got right by one of them alone.
        chance: probability that two equally good models differ at least so much (exact sign test, McNemar 1947).
    """

    fruit: int
    right: int
    other_right: int
    only: int
    only_other: int
    chance: float

    @property
    def verdict(self) -> Verdict:
        """Which is better, as far as it can be told."""
        if self.chance >= SURE:
            return Verdict.ALIKE
        return Verdict.BETTER if self.only > self.only_other else Verdict.WORSE


def compare(right: Sequence[bool], other_right: Sequence[bool]) -> Comparison:
    """Compare two models by whether each got each fruit right.

    Raises:
        ValueError: they judged different numbers of fruit.
    """
    pairs = list(zip(right, other_right, strict=True))
    only = sum(one and not other for one, other in pairs)
    only_other = sum(other and not one for one, other in pairs)
    return Comparison(len(pairs), sum(right), sum(other_right), only, only_other, _sign_test(only, only_other))


def _sign_test(one: int, other: int) -> float:
    """Return the two-sided probability of a split at least so uneven, if either side is as likely."""
    from scipy.stats import binom

    total = one + other
    return 1.0 if total == 0 else min(2.0 * float(binom.cdf(min(one, other), total, 0.5)), 1.0)
