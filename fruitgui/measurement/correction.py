"""What reference fruit taught of volumes, lengths and masses, and how what is fitted is put right by it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from fruitgui.errors import InputError
from fruitgui.measurement.edges import lengths_by_edges, volume_by_edges
from fruitgui.measurement.fruit import Quantity, Size

PRIOR_CHANCE = 0.75
"""Once edges are known, what is left is mostly what nobody saw; about half of it a kind's fruit share as its shift."""

LARGEST_SHARE = 0.5
"""A length grows at most by the root of the volume, where the height is known and the outline is not."""


@dataclass(frozen=True, slots=True)
class Shift:
    """log(true / fitted): its expected value and standard deviation."""

    value: float = 0.0
    std: float = 0.0


@dataclass(frozen=True, slots=True)
class Density:
    """kg/m³, with the spread between fruit of the kind."""

    value: float
    std: float


def _shifted(length: Quantity, share_m: float, shift: Shift) -> Quantity:
    """Return a length that changes by so many metres where the logarithm of the volume changes by one."""
    share_m = float(np.clip(share_m, 0.0, LARGEST_SHARE * length.value))
    return Quantity(length.value + share_m * shift.value, math.hypot(length.std, share_m * shift.std))


@dataclass(frozen=True, slots=True)
class VolumeCorrection:
    """What was learned; `VolumeCorrection()` corrects nothing.

    Attributes:
        common: for kinds without references.
        kinds: for kinds with references.
        chance: factor on the relative standard deviation that the fit gives.
        densities: of kinds where known.
        fattening_px: how far each sensor fattens edges, by its id.
    """

    common: Shift = Shift()
    kinds: Mapping[str, Shift] = field(default_factory=dict)
    chance: float = 1.0
    densities: Mapping[str, Density] = field(default_factory=dict)
    fattening_px: Mapping[str, Quantity] = field(default_factory=dict)

    def volume(self, kind: str, size: Size) -> Quantity:
        """Return the corrected volume, m³, with its honest standard deviation."""
        shift = self.kinds.get(kind, self.common)
        fitted_m3 = volume_by_edges(size, self.fattening_px)
        corrected_m3 = fitted_m3.value * math.exp(shift.value)
        # References mostly lie alone: of what neighbours spoil they teach nothing good.
        chance = math.sqrt(self.chance**2 + size.spoilt * max(PRIOR_CHANCE**2 - self.chance**2, 0.0))
        relative = math.hypot(chance * fitted_m3.std / max(fitted_m3.value, 1e-12), shift.std)
        return Quantity(corrected_m3, corrected_m3 * relative)

    def lengths(self, kind: str, size: Size) -> Size:
        """Return the size with length, diameter and perimeter corrected; the volume stays as fitted.

        What references say that volumes err by, the lengths share as far as the fit cannot tell one from the other.
        """
        shift = self.kinds.get(kind, self.common)
        volume_m3, known = volume_by_edges(size, self.fattening_px), lengths_by_edges(size, self.fattening_px)
        if known.with_volume_m is None or not volume_m3.std > 0.0:
            return known
        shares_m = known.with_volume_m / (volume_m3.std / volume_m3.value) ** 2
        lengths = (known.length_m, known.diameter_m, known.perimeter_m)
        length, diameter, perimeter = (
            _shifted(one, float(share_m), shift) for one, share_m in zip(lengths, shares_m, strict=True)
        )
        return replace(known, length_m=length, diameter_m=diameter, perimeter_m=perimeter)

    def mass(self, kind: str, volume_m3: Quantity) -> Quantity | None:
        """Return the mass, kg, where the kind's density is known."""
        density = self.densities.get(kind)
        if density is None:
            return None
        mass_kg = volume_m3.value * density.value
        relative = math.hypot(volume_m3.std / max(volume_m3.value, 1e-12), density.std / density.value)
        return Quantity(mass_kg, mass_kg * relative)

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, value: Mapping[str, Any]) -> VolumeCorrection:
        """Return the correction in JSON.

        Raises:
            InputError: a field is missing, not a number, or cannot be.
        """
        try:
            return cls(
                _shift(value["common"]),
                {str(kind): _shift(one) for kind, one in _mapping(value["kinds"]).items()},
                _number(value["chance"], 1e-3, 1e3),
                {
                    str(kind): Density(_number(one["value"], 1.0, 1e5), _number(one["std"], 0.0, 1e5))
                    for kind, one in _mapping(value["densities"]).items()
                },
                {
                    str(sensor): Quantity(_number(one["value"], -10.0, 10.0), _number(one["std"], 1e-3, 10.0))
                    for sensor, one in _mapping(value.get("fattening_px", {})).items()
                },
            )
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(
                "bad_model", f"The volume correction cannot be used ({error}).", "Train again.", where="correction"
            ) from error


def _shift(value: Mapping[str, Any]) -> Shift:
    return Shift(_number(value["value"], -1.0, 1.0), _number(value["std"], 0.0, 1.0))


def _mapping(value: object) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise TypeError(f"{str(value)[:40]} is not an object")
    return value


def _number(value: object, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise ValueError(f"{str(value)[:40]} is not a number from {low:g} to {high:g}")
    return float(value)
