"""Which kind was taken for which."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, KindVote, LabelledFruit
from fruitgui.classification.intervals import Rate, rate
from fruitgui.frame import Ints


@dataclass(frozen=True, slots=True)
class Judged:
    """One fruit with what a person and a model say it is."""

    fruit: LabelledFruit
    vote: KindVote

    @property
    def right(self) -> bool:
        """Whether both say the same."""
        return self.vote.kind == self.fruit.kind


@dataclass(frozen=True, slots=True, eq=False)
class Confusion:
    """Counts by fruit: rows what it is, columns what it was taken for.

    Attributes:
        kinds: the trained kinds, then `unknown`.
        counts: (K+1, K+1).
    """

    kinds: tuple[str, ...]
    counts: Ints

    @property
    def right(self) -> Rate:
        """Share of fruit of trained kinds that got their kind; one called unknown is wrong."""
        known = self.counts[:-1]
        return rate(int(np.trace(known)), int(known.sum()))

    @property
    def rejected(self) -> Rate:
        """Share of fruit of trained kinds that were called unknown."""
        known = self.counts[:-1]
        return rate(int(known[:, -1].sum()), int(known.sum()))

    @property
    def strangers_found(self) -> Rate:
        """Share of strangers that were called unknown."""
        return rate(int(self.counts[-1, -1]), int(self.counts[-1].sum()))

    def right_of(self, kind: str) -> Rate:
        """Share of fruit of one kind that got it."""
        row = self.kinds.index(kind)
        return rate(int(self.counts[row, row]), int(self.counts[row].sum()))


def confusion(kinds: tuple[str, ...], judged: Iterable[Judged]) -> Confusion:
    """Count the judged fruit; a fruit of a kind that was never trained counts as `unknown`."""
    columns = (*kinds, UNKNOWN)
    number = {kind: at for at, kind in enumerate(columns)}
    counts = np.zeros((len(columns), len(columns)), dtype=np.intp)
    for one in judged:
        counts[number.get(one.fruit.kind, len(kinds)), number[one.vote.kind]] += 1
    return Confusion(columns, counts)
