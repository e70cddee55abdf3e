"""How well volumes are corrected, on reference fruit that the correction did not see."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from fruitgui.measurement.fruit import Quantity
from fruitgui.measurement.references import Reference, fit_correction
from fruitgui.progress import Cancelled, never_cancelled, stop_if


@dataclass(frozen=True, slots=True)
class Check:
    """One reference fruit, corrected by what the others teach.

    Attributes:
        kind: as labelled.
        true_m3: as a person measured it.
        fitted_m3: before correction.
        corrected_m3: after, by a correction that was learned from all other fruit.
    """

    kind: str
    true_m3: float
    fitted_m3: Quantity
    corrected_m3: Quantity


def check_correction(references: Sequence[Reference], cancelled: Cancelled = never_cancelled) -> tuple[Check, ...]:
    """Return each fruit of measured volume, left out in its turn; nothing where there are fewer than two.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    checks: list[Check] = []
    for number, one in enumerate(references):
        if one.volume_m3 is None or len(references) < 2:
            continue
        stop_if(cancelled)
        others = [*references[:number], *references[number + 1 :]]
        corrected_m3 = fit_correction(others).correction.volume(one.kind, one.size)
        checks.append(Check(one.kind, one.volume_m3, one.size.volume_m3, corrected_m3))
    return tuple(checks)
