"""What lies on the teaching desk: the fruit, their kinds, how far each kind is; no widgets, no disk."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.gui.kind_words import kinds_in_order
from fruitgui.records.insight import Guess, Insight, enough_named
from fruitgui.records.journal import Change
from fruitgui.records.teaching import Brief, KindCount
from fruitgui.station.kind_names import known_kind
from fruitgui.station.workflow import FRUIT_PER_KIND, SAMPLES_PER_KIND

MOST_KEYS = 9
"""Kinds that have a key of their own."""


class Pile(Enum):
    """Which of the fruit are looked at."""

    WAITING = "waiting"
    NAMED = "named"
    DOUBTFUL = "doubtful"


@dataclass(frozen=True, slots=True)
class Shelf:
    """A pile; of the named fruit only one kind where `kind` is given."""

    pile: Pile = Pile.WAITING
    kind: str | None = None


@dataclass(frozen=True, slots=True)
class KindLine:
    """How far one kind is taught.

    Attributes:
        kind: its name.
        key: that gives it: `1` to `9`, `0` for `unknown`, empty for further ones.
        samples, fruit: views and distinct pieces.
        measured: pieces that a person measured.
        density_g_ml: of those with volume and mass, or None.
    """

    kind: str
    key: str
    samples: int
    fruit: int
    measured: int
    density_g_ml: float | None

    @property
    def share(self) -> float:
        """How much of what is needed is there, 0–1: the lesser of samples and pieces."""
        return min(self.samples / SAMPLES_PER_KIND, self.fruit / FRUIT_PER_KIND, 1.0)

    @property
    def full(self) -> bool:
        """Whether it is enough."""
        return self.share >= 1.0


@dataclass(slots=True)
class Desk:
    """The fruit as they are, changed at once as a person names them; the store follows.

    Attributes:
        fruit: by key, the newest first.
        order: kinds in the order of their keys.
        insight: what the model so far thinks.
        settled: doubtful fruit on which a person had the last word.
    """

    fruit: dict[int, Brief] = field(default_factory=dict)
    order: tuple[str, ...] = ()
    insight: Insight = field(default_factory=Insight)
    settled: set[int] = field(default_factory=set)
    _counts: tuple[KindCount, ...] | None = None

    def lay_out(self, fruit: Iterable[Brief], order: Sequence[str]) -> None:
        """Put down what the store holds."""
        self._counts = None
        self.fruit = {one.key: one for one in fruit}
        self.order = kinds_in_order(order, (one.kind for one in self.fruit.values() if one.kind is not None))

    def add_kind(self, kind: str) -> str:
        """Add a kind, and return it; one that people would read as a kind that is there is that one."""
        kind = known_kind(kind, self.order)
        if kind not in (*self.order, UNKNOWN):
            self.order = (*self.order, kind)
        return kind

    def keys(self, shelf: Shelf) -> list[int]:
        """Return the fruit of a shelf, in the order in which they are shown."""
        if shelf.pile is Pile.DOUBTFUL:
            return [key for key in self.insight.mistakes if self._doubtful(key)]
        if shelf.pile is Pile.NAMED:
            named = [one for one in self.fruit.values() if one.kind is not None]
            return [one.key for one in named if shelf.kind in (None, one.kind)]
        waiting = [one.key for one in self.fruit.values() if one.kind is None]
        first = [key for key in self.insight.order if key in self.fruit and self.fruit[key].kind is None]
        return list(dict.fromkeys([*first, *waiting]))

    def _doubtful(self, key: int) -> bool:
        one = self.fruit.get(key)
        return one is not None and one.kind is not None and key not in self.settled

    def guess(self, key: int) -> Guess | None:
        """Return what the model so far takes a fruit for: while it waits, or where it contradicts its kind."""
        one = self.fruit.get(key)
        if one is None:
            return None
        return self.insight.guesses.get(key) if one.kind is None else self._contradiction(key)

    def _contradiction(self, key: int) -> Guess | None:
        return self.insight.mistakes.get(key) if key not in self.settled else None

    def name(self, keys: Iterable[int], kind: str | None) -> None:
        """Give fruit a kind, or let them wait again."""
        self._counts = None
        for key in keys:
            self.fruit[key] = replace(self.fruit[key], kind=kind)
            self.settled.add(key)

    def measure(self, key: int, volume_ml: float | None, mass_g: float | None) -> None:
        """Note what a person measured."""
        self._counts = None
        self.fruit[key] = replace(self.fruit[key], volume_ml=volume_ml, mass_g=mass_g)

    def apply(self, changes: Iterable[Change], *, back: bool) -> list[int]:
        """Follow a step that was taken back or done again; return the fruit that it changed."""
        self._counts = None
        touched = []
        for change in changes:
            if change.taught in self.fruit:
                value = {change.what: change.before if back else change.after}
                self.fruit[change.taught] = replace(self.fruit[change.taught], **value)  # type: ignore[arg-type]
                touched.append(change.taught)
        return list(dict.fromkeys(touched))

    def remove(self, keys: Iterable[int]) -> None:
        """Forget fruit."""
        self._counts = None
        for key in keys:
            self.fruit.pop(key, None)

    def counts(self) -> tuple[KindCount, ...]:
        """Return how much was taught of each kind that has any."""
        if self._counts is None:
            self._counts = self._counted()
        return self._counts

    def _counted(self) -> tuple[KindCount, ...]:
        found: dict[str, list[int]] = {}
        for one in self.fruit.values():
            if one.kind is not None:
                sums = found.setdefault(one.kind, [0, 0, 0])
                sums[0] += one.samples
                sums[1] += 1
                sums[2] += one.measured
        return tuple(KindCount(kind, *sums) for kind, sums in found.items())

    def lines(self) -> list[KindLine]:
        """Return a line for each kind in the order of their keys, `unknown` last."""
        counts, densities = {one.kind: one for one in self.counts()}, self.densities()
        lines = []
        for number, kind in enumerate((*self.order, UNKNOWN), start=1):
            have = counts.get(kind, KindCount(kind, 0, 0, 0))
            key = "0" if kind == UNKNOWN else str(number) if number <= MOST_KEYS else ""
            lines.append(KindLine(kind, key, have.samples, have.fruit, have.measured, densities.get(kind)))
        return lines

    def densities(self) -> Mapping[str, float]:
        """Return the median density, g/ml, of kinds with pieces of which a person measured volume and mass."""
        found: dict[str, list[float]] = {}
        for one in self.fruit.values():
            if one.kind is not None and one.volume_ml is not None and one.mass_g is not None:
                found.setdefault(one.kind, []).append(one.mass_g / one.volume_ml)
        return {kind: statistics.median(values) for kind, values in found.items()}

    @property
    def can_look_through(self) -> bool:
        """Whether a first set was named, so that a model may have a say."""
        return enough_named(self.counts())

    @property
    def done(self) -> bool:
        """Whether at least two kinds are taught, and each of them enough."""
        begun = [one for one in self.lines() if one.fruit and one.kind != UNKNOWN]
        return len(begun) >= 2 and all(one.full for one in begun)
