"""What the fruit named so far teach of the others: suggestions, whom to ask about first, and likely mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from fruitgui.classification.asking import most_telling, uncertainty
from fruitgui.classification.evidence import UNKNOWN, Evidence, KindVote
from fruitgui.classification.model import KindModel
from fruitgui.classification.training import train
from fruitgui.progress import Cancelled, Progress, stop_if
from fruitgui.records.taught import KeptTaught
from fruitgui.records.teaching import KindCount, Teaching
from fruitgui.station.judging import FEATURES

FIRST_FRUIT, FIRST_KINDS = 3, 2
"""Pieces of each of so many kinds that a person names unaided; what a model says before would only mislead."""

MOST_ASKED = 60
"""Fruit that are put in order; after so many answers one looks again."""


@dataclass(frozen=True, slots=True)
class Guess:
    """What a model takes a fruit for, and how surely (0–1)."""

    kind: str
    probability: float


@dataclass(frozen=True, slots=True)
class Insight:
    """What is thought of taught fruit.

    Attributes:
        guesses: of fruit that wait to be named, by key.
        order: keys of fruit that wait, those that would teach most first; not all of them.
        mistakes: of named fruit that a model which never saw them takes for something else, the surest first.
    """

    guesses: Mapping[int, Guess] = field(default_factory=dict)
    order: tuple[int, ...] = ()
    mistakes: Mapping[int, Guess] = field(default_factory=dict)


def enough_named(counts: Sequence[KindCount]) -> bool:
    """Tell whether a first set was named, so that a model may have a say."""
    named = [one for one in counts if one.kind != UNKNOWN and one.fruit >= FIRST_FRUIT]
    return len(named) >= FIRST_KINDS


def look_through(teaching: Teaching, seed: int, progress: Progress, cancelled: Cancelled) -> Insight:
    """Train on what is named so far, and look at everything else with it; nothing is kept.

    Raises:
        InputError: nothing has a kind yet.
        CancelledByUserError: a person stopped it.
    """
    named = list(teaching.walk())
    training = train(
        [one.labelled for one in teaching.for_training()], FEATURES, seed, lambda s, d: progress(0.8 * s, d), cancelled
    )
    stop_if(cancelled)
    progress(0.8, "Looking at the fruit that wait to be named")
    guesses, order = _asked(list(teaching.unnamed()), training.model, cancelled)
    keys = {f"{one.fruit.source}:{one.fruit.source_fruit}": one.key for one in named}
    wrong = sorted((one for one in training.judged if not one.right), key=lambda one: -one.vote.probability)
    mistakes = {keys[one.fruit.fruit_id]: _guess(one.vote) for one in wrong if one.fruit.fruit_id in keys}
    progress(1.0, "Looked through")
    return Insight(guesses, order, mistakes)


def _asked(
    waiting: Sequence[KeptTaught], model: KindModel, cancelled: Cancelled
) -> tuple[dict[int, Guess], tuple[int, ...]]:
    votes: list[KindVote] = []
    for one in waiting:
        stop_if(cancelled)
        votes.append(model.vote(one.fruit.evidence))
    if not votes:
        return {}, ()
    looks = np.array([_looks(one.fruit.evidence) for one in waiting])
    rows = most_telling([uncertainty(vote) for vote in votes], looks, MOST_ASKED)
    guesses = {one.key: _guess(vote) for one, vote in zip(waiting, votes, strict=True)}
    return guesses, tuple(waiting[row].key for row in rows)


def _looks(evidence: Evidence) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.concatenate([evidence.view_features.mean(axis=0, dtype=np.float64), evidence.fruit_features])


def _guess(vote: KindVote) -> Guess:
    return Guess(vote.kind, vote.probability)
