"""What is proposed when a lot starts: the name that follows the last one, and the growers and recipes of before."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fruitgui.records.lot import Lot

FIRST = "1"


@dataclass(frozen=True, slots=True)
class LotWords:
    """Proposals: the next name; growers and recipes, the latest first."""

    name: str
    growers: tuple[str, ...]
    recipes: tuple[str, ...]


def lot_words(lots: Sequence[Lot]) -> LotWords:
    """Return proposals by the lots that were run, the newest first."""
    return LotWords(
        next_name(lots[0].name) if lots else FIRST,
        _distinct(lot.grower for lot in lots),
        _distinct(lot.recipe for lot in lots),
    )


def next_name(name: str) -> str:
    """Return the name with its last number one higher, as many digits long; with a 2 where it has none."""
    found = re.search(r"(\d+)(\D*)$", name)
    if found is None:
        return f"{name} 2"
    number = str(int(found[1]) + 1).zfill(len(found[1]))
    return f"{name[: found.start()]}{number}{found[2]}"


def _distinct(words: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(word for word in words if word))
