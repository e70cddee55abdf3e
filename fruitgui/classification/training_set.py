"""Labelled fruit, checked and sorted for training."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, FeatureNames, LabelledFruit
from fruitgui.classification.kinds import checked_kinds
from fruitgui.classification.model import check_width
from fruitgui.errors import InputError
from fruitgui.frame import Ints


@dataclass(frozen=True, slots=True, eq=False)
class TrainingSet:
    """Labelled fruit sorted for training.

    Attributes:
        kinds: the kinds, in alphabetical order.
        fruit: those of trained kinds.
        numbers: (N,) number of each one's kind.
        pieces: (N,) number of each one's piece of fruit: one that crossed twice has one number.
        strangers: fruit labelled unknown.
    """

    kinds: tuple[str, ...]
    fruit: tuple[LabelledFruit, ...]
    numbers: Ints
    pieces: Ints
    strangers: tuple[LabelledFruit, ...]


def training_set(fruits: Sequence[LabelledFruit], names: FeatureNames) -> TrainingSet:
    """Sort labelled fruit for training.

    Raises:
        InputError: no fruit of a kind, other features than the names say, or kinds that cannot be.
    """
    known = tuple(one for one in fruits if one.kind != UNKNOWN)
    if not known:
        raise InputError("no_labels", "There is no labelled fruit to train on.", "Give some fruit their kind.")
    for one in fruits:
        check_width(one.evidence, names)
    kinds = checked_kinds(sorted({one.kind for one in known}))
    numbers = np.array([kinds.index(one.kind) for one in known], dtype=np.intp)
    piece: dict[tuple[str, str], int] = {}
    pieces = [piece.setdefault((one.source, one.fruit_id), len(piece)) for one in known]
    strangers = tuple(one for one in fruits if one.kind == UNKNOWN)
    return TrainingSet(kinds, known, numbers, np.array(pieces, dtype=np.intp), strangers)
