"""The running line: observations in, finished fruit out. It reads no file and owns no thread."""

from __future__ import annotations

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, Evidence, FeatureNames, KindVote
from fruitgui.frame import F32, F64
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.fruit import Size
from fruitgui.measurement.size import measure
from fruitgui.perception.features import FEATURE_NAMES
from fruitgui.station.fruit import Fruit
from fruitgui.station.model import Model
from fruitgui.tracking.track import Track

FRUIT_FEATURE_NAMES = ("volume_m3", "length_m", "diameter_m", "perimeter_m", "height_m")
"""What measuring adds to the views' features when a kind is decided."""

FEATURES = FeatureNames(FEATURE_NAMES, FRUIT_FEATURE_NAMES)

LEAST_CLEAN_VIEWS = 3
"""With fewer whole views that stand alone, those of touching fruit speak too."""


def evidence(track: Track, size: Size) -> Evidence:
    """Return what a track's kind is decided on: its clean views, or all where those are few."""
    views = [sighting.view for sighting in track.sightings]
    clean = [view for view in views if view.whole and not view.shared]
    chosen = clean if len(clean) >= LEAST_CLEAN_VIEWS else views
    features: F32 = np.stack([view.features for view in chosen]).astype(np.float32)
    return Evidence(features, _fruit_features(track, size))


def _fruit_features(track: Track, size: Size) -> F64:
    height_m = float(np.median([sighting.view.height_m for sighting in track.sightings]))
    return np.array(
        [size.volume_m3.value, size.length_m.value, size.diameter_m.value, size.perimeter_m.value, height_m]
    )
