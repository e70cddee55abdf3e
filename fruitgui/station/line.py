"""The running line: observations in, finished fruit out. It reads no file and owns no thread."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, Evidence, FeatureNames, KindVote
from fruitgui.frame import F32, F64
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.fruit import Size
from fruitgui.measurement.size import measure
from fruitgui.perception.features import FEATURE_NAMES
from fruitgui.perception.view import Observation
from fruitgui.station.fruit import Fruit
from fruitgui.station.model import Model
from fruitgui.station.timing import Stopwatch
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker

FRUIT_FEATURE_NAMES = ("volume_m3", "length_m", "diameter_m", "perimeter_m", "height_m")
"""What measuring adds to the views' features when a kind is decided."""

FEATURES = FeatureNames(FEATURE_NAMES, FRUIT_FEATURE_NAMES)

LEAST_CLEAN_VIEWS = 3
"""With fewer whole views that stand alone, those of touching fruit speak too."""

NOBODY_SAYS = KindVote(UNKNOWN, 1.0, {}, float("inf"))
"""The vote on every fruit where there is no model."""

PaperVolume = Callable[[Track], float]
"""A track's volume by the source's method, m³."""


class Line:
    """Follows, measures and names fruit; each is given out once, when it has left.

    Args:
        rig: the sensors as placed.
        tracker: follows the fruit over that rig.
        model: names and corrects; without one every kind is `unknown` and volumes are as fitted.
        paper_volume: the source's volume beside ours, where it is wanted.
        watch: times the stages.
    """

    def __init__(
        self,
        rig: Rig,
        tracker: Tracker,
        model: Model | None = None,
        paper_volume: PaperVolume | None = None,
        watch: Stopwatch | None = None,
    ) -> None:
        self._rig = rig
        self._tracker = tracker
        self._model = model
        self._paper_volume = paper_volume
        self._watch = watch or Stopwatch()
        self._given_out = 0

    def feed(self, observation: Observation) -> list[Fruit]:
        """Return the fruit that were finished by this observation; they come in order of time."""
        return self.fruit(self.follow(observation))

    def finish(self) -> list[Fruit]:
        """Return the fruit that were still in view when it ended, where they count."""
        return self.fruit(self._tracker.finish())

    def follow(self, observation: Observation) -> list[Track]:
        """Return the tracks that were finished by this observation."""
        with self._watch.stage("track"):
            return self._tracker.update(observation)

    def fruit(self, tracks: Iterable[Track]) -> list[Fruit]:
        """Measure and name finished tracks."""
        return [self._measured(track) for track in tracks]

    def _measured(self, track: Track) -> Fruit:
        with self._watch.stage("measure"):
            size = measure(track, self._rig)
        with self._watch.stage("classify"):
            vote = NOBODY_SAYS if self._model is None else self._model.kinds.vote(evidence(track, size))
        self._given_out += 1
        volume_m3, mass_kg = size.volume_m3, None
        if self._model is not None:
            volume_m3 = self._model.correction.volume(vote.kind, size)
            mass_kg = self._model.correction.mass(vote.kind, volume_m3)
        return Fruit(
            fruit=self._given_out,
            kind=vote.kind,
            kind_probability=vote.probability,
            size=size,
            volume_m3=volume_m3,
            mass_kg=mass_kg,
            volume_paper_m3=None if self._paper_volume is None else self._paper_volume(track),
            views=len(track.path),
            path=track.path,
        )


def evidence(track: Track, size: Size) -> Evidence:
    """Return what a track's kind is decided on: its clean views, or all where those are few."""
    views = [sighting.view for sighting in track.sightings]
    clean = [view for view in views if view.whole and not view.shared]
    chosen = clean if len(clean) >= LEAST_CLEAN_VIEWS else views
    features: F32 = np.stack([view.features for view in chosen]).astype(np.float32)
    return Evidence(features, _fruit_features(track, size), alone=len(clean) >= LEAST_CLEAN_VIEWS)


def _fruit_features(track: Track, size: Size) -> F64:
    height_m = float(np.median([sighting.view.height_m for sighting in track.sightings]))
    return np.array(
        [size.volume_m3.value, size.length_m.value, size.diameter_m.value, size.perimeter_m.value, height_m]
    )
