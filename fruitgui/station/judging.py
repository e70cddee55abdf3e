"""A track measured and named: what it is, how large, and how sure both are. Nothing is counted here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import nan

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, Evidence, FeatureNames, KindVote
from fruitgui.frame import F32, F64
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.correction import VolumeCorrection
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.measurement.shared import shared_mass_std_kg, shared_volume_std_m3
from fruitgui.measurement.size import measure
from fruitgui.perception.features import FEATURE_NAMES
from fruitgui.station.fruit import Fruit
from fruitgui.station.model import Model
from fruitgui.station.timing import Stopwatch
from fruitgui.tracking.track import Track

FRUIT_FEATURE_NAMES = ("volume_m3", "length_m", "diameter_m", "perimeter_m", "height_m")
"""What measuring adds to the views' features when a kind is decided."""

FEATURES = FeatureNames(FEATURE_NAMES, FRUIT_FEATURE_NAMES)

LEAST_CLEAN_VIEWS = 3
"""With fewer whole views that stand alone, those of touching fruit speak too."""

MOSTLY = 0.5
"""Part of its whole views that must show a fruit alone if it is to count as alone."""

NOBODY_SAYS = KindVote(UNKNOWN, 1.0, {})
"""The vote on every fruit where there is no model."""

PaperVolume = Callable[[Track], float]
"""A track's volume by the source's method, m³."""


@dataclass(frozen=True, slots=True, eq=False)
class Judgement:
    """What is thought of one track.

    Attributes:
        vote: its kind.
        size: its lengths corrected by what taught fruit tell, all else as fitted.
        evidence: what the kind was decided on.
        volume_m3: corrected by what reference fruit taught, where they did.
        mass_kg: where the kind's density is known.
        volume_paper_m3: by the source's method, where it was asked for.
        volume_shared_m3, mass_shared_kg: see `Fruit`.
    """

    vote: KindVote
    size: Size
    evidence: Evidence
    volume_m3: Quantity
    mass_kg: Quantity | None
    volume_paper_m3: float | None = None
    volume_shared_m3: float = nan
    mass_shared_kg: float = nan

    def fruit(self, number: int, track: Track) -> Fruit:
        """Return the fruit that a finished track is, with its number."""
        return Fruit(
            fruit=number,
            kind=self.vote.kind,
            kind_probability=self.vote.probability,
            size=self.size,
            volume_m3=self.volume_m3,
            mass_kg=self.mass_kg,
            volume_paper_m3=self.volume_paper_m3,
            views=len(track.path),
            path=track.path,
            volume_shared_m3=self.volume_shared_m3,
            mass_shared_kg=self.mass_shared_kg,
        )


class Judge:
    """Measures and names tracks; remembers none.

    Args:
        rig: the sensors as placed.
        model: names and corrects; without one every kind is `unknown` and volumes are as fitted.
        paper_volume: the source's volume beside ours, where it is wanted.
        watch: times the stages.
    """

    def __init__(
        self,
        rig: Rig,
        model: Model | None = None,
        paper_volume: PaperVolume | None = None,
        watch: Stopwatch | None = None,
    ) -> None:
        self._rig = rig
        self._model = model
        self._paper_volume = paper_volume
        self._watch = watch or Stopwatch()

    def judge(self, track: Track) -> Judgement:
        """Return what a track is and how large."""
        with self._watch.stage("measure"):
            size = measure(track, self._rig)
        with self._watch.stage("classify"):
            decided_on = evidence(track, size)
            vote = NOBODY_SAYS if self._model is None else self._model.kinds.vote(decided_on)
        correction = VolumeCorrection() if self._model is None else self._model.correction
        volume_m3 = correction.volume(vote.kind, size)
        mass_kg = correction.mass(vote.kind, volume_m3)
        shared_m3 = shared_volume_std_m3(correction, vote.kind, size, volume_m3)
        shared_kg = nan if mass_kg is None else shared_mass_std_kg(correction, vote.kind, mass_kg, volume_m3, shared_m3)
        paper_m3 = None if self._paper_volume is None else self._paper_volume(track)
        lengths = correction.lengths(vote.kind, size)
        return Judgement(vote, lengths, decided_on, volume_m3, mass_kg, paper_m3, shared_m3, shared_kg)


def evidence(track: Track, size: Size) -> Evidence:
    """Return what a track's kind is decided on: its clean views; else its whole ones, or all where those are few."""
    views = [sighting.view for sighting in track.sightings]
    whole = [view for view in views if view.whole]
    clean = [view for view in whole if not view.shared]
    # A few views of a fruit that touches another show both as one.
    alone = len(clean) >= max(LEAST_CLEAN_VIEWS, MOSTLY * len(whole))
    uncut = len(whole) >= LEAST_CLEAN_VIEWS
    chosen = clean if alone else whole if uncut else views
    features: F32 = np.stack([view.features for view in chosen]).astype(np.float32)
    return Evidence(features, _fruit_features(track, size), alone, uncut)


def _fruit_features(track: Track, size: Size) -> F64:
    height_m = float(np.median([sighting.view.height_m for sighting in track.sightings]))
    return np.array(
        [size.volume_m3.value, size.length_m.value, size.diameter_m.value, size.perimeter_m.value, height_m]
    )
