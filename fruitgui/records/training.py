"""Training on what a store holds: the job of the command line, and what is worth knowing beside the model."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fruitgui.classification.comparing import Comparison, compare
from fruitgui.classification.confusion import Judged
from fruitgui.errors import InputError
from fruitgui.measurement.checking import Check, check_correction
from fruitgui.measurement.references import Reference
from fruitgui.progress import Cancelled, Progress, stop_if
from fruitgui.records.models import Models, ModelVersion
from fruitgui.records.store import Store
from fruitgui.station.model import Model
from fruitgui.station.train_job import Taught, TrainOutcome, train_taught

LEAST_UNSEEN = 10
"""Fruit that the model in use has not learned from, from which on two models are compared on those alone."""

MOST_CHECKED = 120
"""Reference fruit that are left out in their turn; more would say little and take long."""


@dataclass(frozen=True, slots=True)
class Rivals:
    """The new model against the one in use, on the same fruit; the new one never saw any of them.

    Attributes:
        comparison: the new one first.
        seen: how many of the fruit the one in use learned from, which flatters it; None where it is not known.
    """

    comparison: Comparison
    seen: int | None


@dataclass(frozen=True, slots=True, eq=False)
class Trained:
    """A model that was trained and waits to be accepted.

    Attributes:
        outcome: the model, and how good it is.
        taught: fingerprint of what it learned from.
        keys: of the fruit in the store, by the names that the outcome gives them.
        rivals: against the model in use; None without one, or where it wants other features.
        checks: reference fruit, each corrected by the others.
    """

    outcome: TrainOutcome
    taught: str
    keys: Mapping[str, int]
    rivals: Rivals | None
    checks: tuple[Check, ...]

    @property
    def trained_on(self) -> dict[str, Any]:
        """What it learned from, for the list of models."""
        kinds = [{"kind": one.kind, "fruit": one.fruit} for one in self.outcome.training.taught]
        return {"taught": self.taught, "kinds": kinds, "fruit": sorted(self.keys.values())}

    @property
    def held_out(self) -> dict[str, Any]:
        """How it did on fruit held out, for the list of models."""
        right = self.outcome.training.confusion.right
        if not right.trials:
            return {}
        return {"right": right.value, "low": right.low, "high": right.high, "fruit": right.trials}


def train_store(
    store: Store,
    in_use: Callable[[], Model | None],
    out: Path,
    seed: int,
    progress: Progress,
    cancelled: Cancelled,
) -> Trained:
    """Train on all fruit that have a kind.

    Args:
        store: that holds them.
        in_use: reads the model in use, for comparison.
        out: the model's file.
        seed: of all chance.
        progress, cancelled: see `progress`.

    Raises:
        InputError: nothing has a kind yet.
        WorldError: the model cannot be written.
        CancelledByUserError: a person stopped it.
    """
    facts = store.teaching.facts()
    keys = {f"{one.fruit.source}:{one.fruit.source_fruit}": one.key for one in store.teaching.walk()}
    taught = store.teaching.for_training()
    sources = sorted({one.labelled.source for one in taught})
    outcome = train_taught(
        taught, {"recordings": sources}, out, seed, lambda share, doing: progress(0.85 * share, doing), cancelled
    )
    stop_if(cancelled)
    progress(0.85, "Comparing with the model in use")
    rivals = _rivals(outcome.training.judged, in_use(), _seen(store.models, keys))
    progress(0.9, "Checking volumes")
    checks = check_correction(_references(taught), cancelled)
    progress(1.0, "Trained")
    return Trained(outcome, "" if facts is None else facts.fingerprint, keys, rivals, checks)


def _references(taught: Sequence[Taught]) -> list[Reference]:
    known = [one for one in taught if one.volume_m3 is not None or one.mass_kg is not None]
    return [Reference(one.labelled.kind, one.size, one.volume_m3, one.mass_kg) for one in known[-MOST_CHECKED:]]


def _seen(models: Models, keys: Mapping[str, int]) -> frozenset[str] | None:
    """Return the names of the fruit that the model in use learned from; None where it is not known."""
    version: ModelVersion | None = models.in_use()
    learned = None if version is None else version.trained_on.get("fruit")
    return None if not isinstance(learned, list) else frozenset(name for name, key in keys.items() if key in learned)


def _rivals(judged: Sequence[Judged], model: Model | None, seen: frozenset[str] | None) -> Rivals | None:
    if model is None or not judged:
        return None
    unseen = [] if seen is None else [one for one in judged if one.fruit.fruit_id not in seen]
    both = unseen if len(unseen) >= LEAST_UNSEEN else list(judged)
    try:
        votes = [model.kinds.vote(one.fruit.evidence) for one in both]
    except InputError:
        return None
    other_right = [vote.kind == one.fruit.kind for vote, one in zip(votes, both, strict=True)]
    known = None if seen is None else sum(one.fruit.fruit_id in seen for one in both)
    return Rivals(compare([one.right for one in both], other_right), known)
