"""What measuring gives: a track's volume and size with how sure each is."""

from __future__ import annotations

from dataclasses import dataclass

from fruitgui.frame import F64


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value and its standard deviation; the 95 % interval is ±1.96 of it."""

    value: float
    std: float


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    """How far a fit found each sensor to fatten edges, which it can hardly tell from the fruit's own size.

    Attributes:
        sensors: S ids.
        fattening_px: (S,) as found on this fruit.
        covariance_px2: (S, S) of it.
        with_volume_px: (S,) its covariance with the logarithm of the volume.
        with_lengths_px_m: (3, S) its covariance with length, diameter and perimeter; None where it was not kept.
    """

    sensors: tuple[str, ...]
    fattening_px: F64
    covariance_px2: F64
    with_volume_px: F64
    with_lengths_px_m: F64 | None = None


@dataclass(frozen=True, slots=True)
class Size:
    """Volume and size of one fruit, SI units, uncorrected by reference fruit.

    Attributes:
        volume_m3: of the fitted closed surface.
        length_m: the largest calliper distance.
        diameter_m: the largest calliper distance at right angles to the length.
        perimeter_m: of the outline projected along the belt's normal.
        coverage: share of the fitted surface (0–1) that was seen.
        edges: what volume and lengths owe to fattened edges; None where no surface was fitted.
        spoilt: share of the views used (0–1) that a neighbour or the picture's edge spoils.
        with_volume_m: (3,) covariance of length, diameter and perimeter with the logarithm of the volume; None where no
            surface was fitted, or it was not kept.
    """

    volume_m3: Quantity
    length_m: Quantity
    diameter_m: Quantity
    perimeter_m: Quantity
    coverage: float
    edges: Edges | None = None
    spoilt: float = 0.0
    with_volume_m: F64 | None = None
