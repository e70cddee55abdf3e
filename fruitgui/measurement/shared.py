"""What all fruit of a kind err by together: it does not average out, however many there are."""

from __future__ import annotations

import math

import numpy as np

from fruitgui.measurement.correction import VolumeCorrection
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.measurement.size import SYSTEMATIC
from fruitgui.measurement.sums import USUAL_SHARE


def shared_volume_std_m3(correction: VolumeCorrection, kind: str, size: Size, volume_m3: Quantity) -> float:
    """Return the part of a corrected volume's standard deviation, m³, that other fruit of its kind share.

    References leave the doubt of their kind's shift. Without them it is the sensors' edges, which fatten every fruit
    alike, and about half of the rest. Nothing takes out the device's own scale and the belt's plane.
    """
    std = volume_m3.std / max(volume_m3.value, 1e-12)
    shift = correction.kinds.get(kind, correction.common)
    known = shift.std if correction.kinds or shift.std else _untaught(size)
    return min(math.hypot(known, SYSTEMATIC), std) * volume_m3.value


def shared_mass_std_kg(
    correction: VolumeCorrection, kind: str, mass_kg: Quantity, volume_m3: Quantity, shared_m3: float
) -> float:
    """Return the part of a mass's standard deviation, kg, that other fruit of its kind share.

    How much of a density's own is the spread between fruit is not kept, so all of it counts as shared: at worst, the ±
    of a sum of masses is too wide.
    """
    density = correction.densities[kind]
    relative = math.hypot(shared_m3 / max(volume_m3.value, 1e-12), density.std / density.value)
    return min(relative * mass_kg.value, mass_kg.std)


def _untaught(size: Size) -> float:
    """Return the relative part that fruit share where no reference fruit taught anything."""
    variance = (size.volume_m3.std / max(size.volume_m3.value, 1e-12)) ** 2
    by_edges = 0.0
    if size.edges is not None:
        toward = size.edges.with_volume_px
        by_edges = min(float(toward @ np.linalg.lstsq(size.edges.covariance_px2, toward, rcond=None)[0]), variance)
    return math.sqrt(by_edges + USUAL_SHARE**2 * (variance - by_edges))
