"""Numbers as people read them: thin spaces, ±, and no more digits than are known."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QLocale

THIN = "\u2009"
NARROW = "\u202f"


def count_text(count: int) -> str:
    """Return a count with its thousands apart."""
    return f"{count:,}".replace(",", NARROW)


def decimals_for(std: float) -> int:
    """Return to how many places after the point a value with this deviation is known: two digits below 3, else one."""
    if not std > 0 or not math.isfinite(std):
        return 1
    power = math.floor(math.log10(std))
    return max(int(std < 3 * 10.0**power) - power, 0)


def number_text(value: float, decimals: int) -> str:
    """Return a number with so many decimals, in the window's language."""
    locale = QLocale()
    locale.setNumberOptions(QLocale.NumberOption.OmitGroupSeparator)
    return locale.toString(float(value), "f", decimals)


def measured_text(value: float, std: float, unit: str) -> str:
    """Return a measured value with the half width of its 95 % interval."""
    half = 1.96 * std
    decimals = min(decimals_for(half), 1)
    return f"{number_text(value, decimals)} ± {number_text(half, decimals)}{THIN}{unit}"


def shares_text(counts: Sequence[int]) -> list[str]:
    """Return counts as percentages with a decimal that sum to 100: none of what is there is 0, no part is the whole."""
    whole = sum(counts)
    exact = [1000 * count / max(whole, 1) for count in counts]
    tenths = [max(math.floor(one), min(count, 1)) for one, count in zip(exact, counts, strict=True)]
    by_rest = sorted(range(len(counts)), key=lambda at: tenths[at] - exact[at])
    for at in by_rest[: max(1000 - sum(tenths), 0) if whole else 0]:
        tenths[at] += 1
    if tenths and whole:
        tenths[tenths.index(max(tenths))] += 1000 - sum(tenths)
    return [f"{number_text(one / 10, 1)}{THIN}%" for one in tenths]


def percent_text(share: float) -> str:
    """Return a share (0–1) as a percentage that never says 100 % of what is not certain."""
    percent = math.floor(share * 100) if share < 1 else 100
    return f"{percent}{THIN}%"
