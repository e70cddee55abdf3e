"""What the source makes of a track: every view measured alone, then the mean (paper 3.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.geometry.rig import Rig
from fruitgui.measurement.fruit import Quantity
from fruitgui.perception.paper import paper_perimeter_m, paper_volume_m3
from fruitgui.tracking.track import Track


@dataclass(frozen=True, slots=True)
class PaperSize:
    """Mean over views, with the standard error that their scatter gives; the source states none.

    Attributes:
        volume_m3: of the mirrored hulls.
        perimeter_m: of the ellipses.
    """

    volume_m3: Quantity
    perimeter_m: Quantity


def paper_volume(track: Track) -> float:
    """Return a track's volume, m³: the mean over its views of the hull of the seen half and its mirror image."""
    return _mean([paper_volume_m3(sighting.view.points_m) for sighting in track.sightings]).value


def paper_size(track: Track, rig: Rig) -> PaperSize:
    """Return a track's volume and perimeter the source's way."""
    views = [sighting.view for sighting in track.sightings]
    perimeters_m = [paper_perimeter_m(view, rig.mounts[view.sensor].intrinsics) for view in views]
    return PaperSize(_mean([paper_volume_m3(view.points_m) for view in views]), _mean(perimeters_m))


def _mean(values: Sequence[float]) -> Quantity:
    """Return the mean and its standard error."""
    error = float(np.std(values, ddof=1) / np.sqrt(len(values))) if len(values) > 1 else float(values[0])
    return Quantity(float(np.mean(values)), error)
