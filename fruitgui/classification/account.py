"""What is known about a trained model: honest figures, mistakes, and warnings for the operator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from fruitgui.classification.confusion import Confusion, Judged, confusion
from fruitgui.classification.evidence import UNKNOWN, LabelledFruit
from fruitgui.classification.intervals import Rate

FEW_VIEWS = 50
"""The source taught each kind by fifty samples (paper 3.3)."""

FEW_FRUIT = 10
"""Fifty views of two fruit teach little: nine in ten of a kind are within the range of ten of them."""

_UNEVEN = 4.0
_WORST = 20

Model = TypeVar("Model")


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """How many held-out fruit get their kind when training has so many fruit."""

    fruit: int
    right: Rate


@dataclass(frozen=True, slots=True)
class Taught:
    """By how many fruit and views one kind was taught."""

    kind: str
    fruit: int
    views: int


@dataclass(frozen=True, slots=True, eq=False)
class Training(Generic[Model]):
    """A model and what is known about it.

    Attributes:
        model: fitted to all fruit.
        taught: fruit and views of each kind, `unknown` last if it was labelled.
        judged: every fruit that could be held out, judged by a model that never saw it.
        confusion: of those, by fruit.
        curve: how the share of right ones grew with the fruit in training; the last point has all of them.
        worst: held-out fruit that were got wrong, the surest mistake first; at most twenty.
        warnings: sentences for the operator.
    """

    model: Model
    taught: tuple[Taught, ...]
    judged: tuple[Judged, ...]
    confusion: Confusion
    curve: tuple[CurvePoint, ...]
    worst: tuple[Judged, ...]
    warnings: tuple[str, ...]


def account(
    model: Model,
    kinds: tuple[str, ...],
    fruits: Sequence[LabelledFruit],
    judged: Sequence[Judged],
    curve: Sequence[CurvePoint],
) -> Training[Model]:
    """Return the model with what follows from its judgement of the fruit held out."""
    taught = tuple(_taught(kind, fruits) for kind in (*kinds, UNKNOWN))
    taught = tuple(one for one in taught if one.fruit)
    counted = confusion(kinds, judged)
    whole = CurvePoint(sum(one.kind != UNKNOWN for one in fruits), counted.right)
    wrong = sorted((one for one in judged if not one.right), key=lambda one: -one.vote.probability)
    warnings = _warnings([one for one in taught if one.kind != UNKNOWN])
    return Training(model, taught, tuple(judged), counted, (*curve, whole), tuple(wrong[:_WORST]), warnings)


def _taught(kind: str, fruits: Sequence[LabelledFruit]) -> Taught:
    own = [one for one in fruits if one.kind == kind]
    pieces = {(one.source, one.fruit_id) for one in own}
    return Taught(kind, len(pieces), sum(one.evidence.views for one in own))


def _warnings(taught: Sequence[Taught]) -> tuple[str, ...]:
    warnings: list[str] = []
    for one in taught:
        if one.fruit < FEW_FRUIT:
            said = "cannot be judged on fruit it has not seen" if one.fruit == 1 else "teach little"
            warnings.append(f"{one.kind}: only {one.fruit} distinct fruit, which {said}; show {FEW_FRUIT} or more.")
        if one.views < FEW_VIEWS:
            warnings.append(f"{one.kind}: only {one.views} views; show {FEW_VIEWS} or more.")
    most, least = max(taught, key=lambda one: one.fruit), min(taught, key=lambda one: one.fruit)
    if most.fruit > _UNEVEN * least.fruit:
        warnings.append(f"Uneven: {most.fruit} of {most.kind} but {least.fruit} of {least.kind}; show more of those.")
    if len(taught) == 1:
        warnings.append("Only one kind: the model can tell it from what is not it, nothing more.")
    return tuple(warnings)
