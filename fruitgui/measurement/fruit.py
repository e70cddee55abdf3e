"""What measuring gives: a track's volume and size with how sure each is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value and its standard deviation; the 95 % interval is ±1.96 of it."""

    value: float
    std: float


@dataclass(frozen=True, slots=True)
class Size:
    """Volume and size of one fruit, SI units, uncorrected by reference fruit.

    Attributes:
        volume_m3: of the fitted closed surface.
        length_m: the largest calliper distance.
        diameter_m: the largest calliper distance at right angles to the length.
        perimeter_m: of the outline projected along the belt's normal.
        coverage: share of the fitted surface (0–1) that was seen.
    """

    volume_m3: Quantity
    length_m: Quantity
    diameter_m: Quantity
    perimeter_m: Quantity
    coverage: float
