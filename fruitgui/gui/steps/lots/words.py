"""What the screen says of lots and fruit: numbers with ±, times, states."""

from __future__ import annotations

import math

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.numbers import THIN, decimals_for, number_text
from fruitgui.measurement.fruit import Quantity
from fruitgui.records.distribution import Measured
from fruitgui.records.lot import ASKED, NOT_RUNNING

translate = QCoreApplication.translate

HALF_95 = 1.96
"""Standard deviations that the half width of a 95 % interval is."""

L_PER_M3 = 1e3
NONE = "–"

UNITS: dict[Measured, tuple[float, str]] = {
    "volume_m3": (1e6, "ml"), "mass_kg": (1e3, "g"), "diameter_m": (1e3, "mm"), "length_m": (1e3, "mm"),
    "perimeter_m": (1e3, "mm"),
}  # fmt: skip
"""What each measure of a fruit is multiplied by for people, and their unit."""

SPREAD: tuple[Measured, ...] = ("volume_m3", "diameter_m", "length_m", "mass_kg")
"""The measures whose spread is shown, in this order."""


def quantity_text(quantity: Quantity | None, factor: float, unit: str, most: int = 1) -> str:
    """Return a measurement with the half width of its 95 % interval, with at most so many decimals."""
    if quantity is None:
        return NONE
    value, half = quantity.value * factor, HALF_95 * quantity.std * factor
    if not math.isfinite(half):
        return f"{number_text(value, most)}{THIN}{unit}"
    decimals = min(decimals_for(half), most)
    return f"{number_text(value, decimals)} ± {number_text(half, decimals)}{THIN}{unit}"


def measure_text(measured: Measured, quantity: Quantity | None) -> str:
    """Return one fruit's measure with its ±."""
    return quantity_text(quantity, *UNITS[measured])


def litres_text(volume: Quantity | None) -> str:
    """Return a sum of volumes with its ±."""
    return quantity_text(volume, L_PER_M3, "l", 2)


def kilograms_text(mass: Quantity | None) -> str:
    """Return a sum of masses with its ±."""
    return quantity_text(mass, 1.0, "kg", 2)


def why_text(why: str) -> str:
    """Return why a lot paused."""
    if why == ASKED:
        return translate("Lots", "paused")
    if why == NOT_RUNNING:
        return translate("Lots", "the program was not running")
    return why


def measure_name(measured: Measured) -> str:
    """Return what a measure of fruit is called."""
    return {
        "volume_m3": translate("Lots", "Volume"),
        "mass_kg": translate("Lots", "Mass"),
        "diameter_m": translate("Lots", "Diameter"),
        "length_m": translate("Lots", "Length"),
        "perimeter_m": translate("Lots", "Perimeter"),
    }[measured]
