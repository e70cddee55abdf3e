"""What reference fruit of measured volume teach: a factor for each kind, and how far it can be trusted.

The model is multiplicative: log(true / fitted) of a fruit is its kind's own
shift plus chance. Kinds share a common shift from which each departs as far as
its references make it (normal-normal shrinkage, Gelman et al. 2013, "Bayesian
data analysis", 5.4). Chance is what the fit said of itself, times one factor
that the references teach.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from fruitgui.frame import F64, Bools
from fruitgui.measurement.correction import PRIOR_CHANCE, Density, Shift, VolumeCorrection
from fruitgui.measurement.edges import learn_fattening, volume_by_edges
from fruitgui.measurement.fruit import Size
from fruitgui.measurement.shrinkage import between, learned

PRIOR_FRUIT = 6.0
"""The fit's own word counts as much as so many references about how far it errs."""

STUDENT_WIDER = 1.3
"""Of n fruit, Student's 95 % interval is 1 + 1.3 / n times wider than the normal one (within 2 % from n = 5)."""

LEAST_CHANCE = 0.01
"""No beaker and no fit is better than this; references that agree by luck prove nothing."""

TYPING_ERROR_SIGMAS = 5.0
LARGEST_SHIFT = math.log(2.0)
"""A reference that is off by more than a factor of two was mistyped, or belongs to another fruit."""


@dataclass(frozen=True, slots=True)
class Reference:
    """One fruit that a person measured.

    Attributes:
        kind: as labelled.
        size: as fitted.
        volume_m3, mass_kg: as measured, or None.
    """

    kind: str
    size: Size
    volume_m3: float | None
    mass_kg: float | None


@dataclass(frozen=True, slots=True)
class Residual:
    """One reference fruit before and after.

    Attributes:
        kind: as labelled.
        true_m3: as measured.
        fitted_m3: before correction.
        corrected_m3: after.
        used: false where it was taken for a typing error.
    """

    kind: str
    true_m3: float
    fitted_m3: float
    corrected_m3: float
    used: bool


@dataclass(frozen=True, slots=True)
class CorrectionFit:
    """A correction with the residuals it leaves."""

    correction: VolumeCorrection
    residuals: tuple[Residual, ...]

    def value(self) -> dict[str, Any]:
        """Return it as JSON for a report: millilitres."""
        return {
            "references": [
                {
                    "kind": one.kind,
                    "true_ml": one.true_m3 * 1e6,
                    "fitted_ml": one.fitted_m3 * 1e6,
                    "corrected_ml": one.corrected_m3 * 1e6,
                    "used": one.used,
                }
                for one in self.residuals
            ],
            "correction": self.correction.to_dict(),
        }

    def lines(self) -> list[str]:
        """Return what to tell a person."""
        if not self.residuals:
            return ["No reference fruit: volumes stay as fitted."]
        used = [one for one in self.residuals if one.used]
        lines = [f"Volume correction from {len(used)} reference fruit (error before and after, mean over fruit):"]
        for kind in sorted({one.kind for one in used}):
            own = [one for one in used if one.kind == kind]
            before, after = _errors(own)
            lines.append(f"  {kind:<24} {len(own):>4} fruit  {before:6.1%} → {after:5.1%}")
        left_out = len(self.residuals) - len(used)
        return [*lines, f"  {left_out} left out as mistyped"] if left_out else lines


def _errors(residuals: Sequence[Residual]) -> tuple[float, float]:
    before = float(np.mean([abs(one.fitted_m3 / one.true_m3 - 1.0) for one in residuals]))
    after = float(np.mean([abs(one.corrected_m3 / one.true_m3 - 1.0) for one in residuals]))
    return before, after


def fit_correction(references: Iterable[Reference]) -> CorrectionFit:
    """Learn shifts, chance and densities from reference fruit; robust against some mistyped ones."""
    given = list(references)
    densities = _densities(given)
    known = [(one, volume) for one in given if (volume := _volume_m3(one, densities)) is not None]
    if not known:
        return CorrectionFit(VolumeCorrection(densities=densities), ())
    kinds = np.array([one.kind for one, _ in known])
    fattening_px = learn_fattening([one.size for one in given])
    fitted = [volume_by_edges(one.size, fattening_px) for one, _ in known]
    log_ratio = np.array([math.log(true / one.value) for (_, true), one in zip(known, fitted, strict=True)])
    spread = np.array([max(one.std / one.value, LEAST_CHANCE) for one in fitted])
    used = _plausible(kinds, log_ratio, spread)
    shifts = _fit(kinds[used], log_ratio[used], spread[used], PRIOR_CHANCE if fattening_px else 1.0)
    correction = replace(shifts, densities=densities, fattening_px=fattening_px)
    residuals = [
        Residual(
            one.kind,
            volume,
            one.size.volume_m3.value,
            correction.volume(one.kind, one.size).value,
            bool(use),
        )
        for (one, volume), use in zip(known, used, strict=True)
    ]
    return CorrectionFit(correction, tuple(residuals))


def _densities(references: Sequence[Reference]) -> dict[str, Density]:
    """Return the densities of kinds with references that have both volume and mass."""
    found: dict[str, list[float]] = {}
    for one in references:
        if one.volume_m3 is not None and one.mass_kg is not None:
            found.setdefault(one.kind, []).append(one.mass_kg / one.volume_m3)
    return {
        kind: Density(float(np.median(values)), max(float(np.std(values)), 0.01 * float(np.median(values))))
        for kind, values in found.items()
    }


def _volume_m3(reference: Reference, densities: Mapping[str, Density]) -> float | None:
    """Return the measured volume; from the mass alone only where the kind's density is known."""
    if reference.volume_m3 is not None:
        return reference.volume_m3
    density = densities.get(reference.kind)
    if density is None or reference.mass_kg is None:
        return None
    return reference.mass_kg / density.value


def _plausible(kinds: np.ndarray[Any, Any], log_ratio: F64, spread: F64) -> Bools:
    """Tell references from typing errors: near to the others of their kind, or of all kinds where few are its own."""
    centre = np.array([_middle(log_ratio[kinds == kind], log_ratio) for kind in kinds])
    apart = np.abs(log_ratio - centre)
    scale = np.maximum(1.4826 * float(np.median(apart)), spread)
    return np.asarray((apart <= TYPING_ERROR_SIGMAS * scale) & (np.abs(log_ratio) <= LARGEST_SHIFT))


def _middle(own: F64, everyone: F64) -> float:
    return float(np.median(own if len(own) >= 3 else everyone))


def _fit(kinds: np.ndarray[Any, Any], log_ratio: F64, spread: F64, usual: float) -> VolumeCorrection:
    if not len(log_ratio):
        return VolumeCorrection()
    names = sorted(set(kinds.tolist()))
    chance = usual
    for _ in range(5):
        weight = 1.0 / (chance * spread) ** 2
        information = np.array([weight[kinds == name].sum() for name in names])
        means = np.array([np.average(log_ratio[kinds == name], weights=weight[kinds == name]) for name in names])
        apart2, (middle, middle_std) = between(means, 1.0 / information)
        own = 1.0 / (information + 1.0 / apart2)
        shifts = own * (information * means + middle / apart2)
        by_name = dict(zip(names, shifts.tolist(), strict=True))
        left = (log_ratio - np.array([by_name[kind] for kind in kinds.tolist()])) / spread
        freedom = max(len(left) - learned(information, apart2), 0.0)
        chance = math.sqrt((PRIOR_FRUIT * usual**2 + float(left @ left)) / (PRIOR_FRUIT + freedom))
    chance *= 1.0 + STUDENT_WIDER / (PRIOR_FRUIT + freedom)
    found = {name: Shift(float(s), math.sqrt(v)) for name, s, v in zip(names, shifts, own, strict=True)}
    return VolumeCorrection(Shift(middle, math.hypot(middle_std, math.sqrt(apart2))), found, chance)
