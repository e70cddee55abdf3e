"""One pair of sensors: find the shift between them with no guess, or say why it cannot be told."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from fruitgui.calibration import borders, coarse, fine
from fruitgui.calibration.evidence import Evidence, evidence
from fruitgui.calibration.fine import Fit
from fruitgui.calibration.flat import Shift
from fruitgui.calibration.held import Held, held
from fruitgui.calibration.ready import Ready
from fruitgui.calibration.relief import Relief
from fruitgui.calibration.result import Code, PairQuality
from fruitgui.calibration.scale import Scale, scale_between
from fruitgui.frame import F64

QUICK_M = (0.03, 0.03, 0.03, 0.02, 0.015, 0.012)
DIFFERENT_M, DIFFERENT_RAD = 0.008, float(np.radians(0.7))
FEWEST_THINGS = 3
FEWEST_ON_TEXTURE = 2
FOR_TEXTURE = 15.0
"""A texture alike by eight standard deviations of chance is worth three things that meet."""

ENOUGH_TO_TELL_MOVED = 5
LEAST_EVIDENCE = 22.0
LEAST_MARGIN = 12.0
WORST_POSITION_STD_M = 0.0015
WORST_HEADING_STD_RAD = float(np.radians(0.15))


@dataclass(frozen=True, slots=True, eq=False)
class Hypothesis:
    """A shift with its fit, what speaks for it, and what else holds it, where that was asked."""

    fit: Fit
    evidence: Evidence
    held: Held | None = None

    @property
    def shift(self) -> Shift:
        """The shift, source's belt frame → target's."""
        return self.fit.shift if self.held is None else self.held.shift

    @property
    def textured(self) -> bool:
        """Whether the belt's texture bears it out."""
        return self.held is not None and self.held.textured

    @property
    def support(self) -> float:
        """All that speaks for it (log scale)."""
        return self.evidence.log_likelihood + FOR_TEXTURE * self.textured


@dataclass(frozen=True, slots=True, eq=False)
class Registration:
    """What is known about one pair.

    Attributes:
        source, target: the sensors; the shift maps the source's belt frame into the target's.
        code: why it is not accepted; None where it is.
        what: one sentence on it.
        best: the best hypothesis, also of a pair that is not accepted.
        start: the best hypothesis before refinement, for the paper's own method.
        covariance: (3, 3) of (x, y, θ) about the target belt frame's origin; None where not accepted.
        quality: for people.
    """

    source: str
    target: str
    code: Code | None
    what: str
    best: Hypothesis | None
    start: Shift | None
    covariance: F64 | None
    quality: PairQuality


def register(source: Ready, target: Ready, expected: Shift | None = None) -> Registration:
    """Find the shift from the source's belt frame into the target's, or refuse.

    Where other pairs already tell roughly which shift to expect, only that one is measured and judged.
    """
    if min(source.relief.things, target.relief.things) == 0:
        bare = source.relief.sensor if source.relief.things == 0 else target.relief.sensor
        return _refused(source, target, "too_little_structure", f"{bare} sees a bare belt.", [])
    ranked = _witnessed(source, target, _ranked(source, target, expected))
    code, what = _verdict(source, target, ranked)
    if code is not None:
        return _refused(source, target, code, what, ranked)
    best, start = ranked[0]
    return Registration(
        source.relief.sensor,
        target.relief.sensor,
        None,
        "",
        best,
        start,
        None if best.held is None else best.held.about_origin,
        _quality(source, target, ranked, accepted=True),
    )


def _ranked(source: Ready, target: Ready, expected: Shift | None = None) -> list[tuple[Hypothesis, Shift]]:
    """Return materially different hypotheses with where each started, most convincing first, the leaders refined."""
    starts = _starts(source, target) if expected is None else [expected]
    quick = _tried(source, target, starts, source.thin, QUICK_M)
    if not quick:
        return []
    quick += _tried(source, target, _turned_half(quick[0][0]), source.thin, QUICK_M)
    leaders = _different(source.relief, quick)[:6]
    bound = leaders[0][0].evidence.log_likelihood - 4 * LEAST_MARGIN
    close = [entry for entry in leaders if entry[0].evidence.log_likelihood > bound]
    refined = [
        (hypothesis, start)
        for found, start in close
        for hypothesis, _ in _tried(source, target, [found.shift], source.relief, fine.SCHEDULE_M[4:])
    ]
    return _different(source.relief, refined)


def _witnessed(source: Ready, target: Ready, ranked: list[tuple[Hypothesis, Shift]]) -> list[tuple[Hypothesis, Shift]]:
    """Return hypotheses with what else holds those that might be the best, most convincing first."""
    if not ranked or ranked[0][0].evidence.agreeing < FEWEST_ON_TEXTURE:
        return ranked
    bound = ranked[0][0].evidence.log_likelihood - FOR_TEXTURE - LEAST_MARGIN
    asked = [
        (replace(one, held=held(source, target, one.fit)) if one.evidence.log_likelihood > bound else one, start)
        for one, start in ranked
    ]
    return sorted(asked, key=lambda entry: -entry[0].support)


def _starts(source: Ready, target: Ready) -> list[Shift]:
    starts = coarse.hypotheses(source.relief, target.relief)
    heading = borders.heading_between(source.borders, target.borders)
    if heading is not None:
        starts += coarse.along_borders(source.relief, target.relief, heading)
    return starts


def _tried(
    source: Ready, target: Ready, starts: list[Shift], relief: Relief, schedule_m: tuple[float, ...]
) -> list[tuple[Hypothesis, Shift]]:
    tried = []
    for start in starts:
        fit = fine.refine(relief, target.target, start, schedule_m)
        if fit is not None:
            said = evidence(source.sight, target.sight, fit.shift, fit.bias_m)
            tried.append((Hypothesis(fit, said), start))
    return sorted(tried, key=lambda entry: -entry[0].evidence.log_likelihood)


def _turned_half(best: Hypothesis) -> list[Shift]:
    """Return the best shift turned by half a circle about what was matched: belts and rails look the same so."""
    return [best.shift.about(best.fit.matched.centre_m, np.array([0.0, 0.0, np.pi]))]


def _different(relief: Relief, entries: list[tuple[Hypothesis, Shift]]) -> list[tuple[Hypothesis, Shift]]:
    ordered = sorted(entries, key=lambda entry: -entry[0].evidence.log_likelihood)
    kept: list[tuple[Hypothesis, Shift]] = []
    at_m = relief.points_m[::20, :2]
    for entry in ordered:
        gaps = [entry[0].shift.apart(other.shift, at_m) for other, _ in kept]
        if all(far > DIFFERENT_M or turned > DIFFERENT_RAD for far, turned in gaps):
            kept.append(entry)
    return kept


def _margin(ranked: list[tuple[Hypothesis, Shift]]) -> float:
    if len(ranked) < 2:
        return ranked[0][0].support
    return ranked[0][0].support - ranked[1][0].support


def _verdict(source: Ready, target: Ready, ranked: list[tuple[Hypothesis, Shift]]) -> tuple[Code | None, str]:
    names = f"{source.relief.sensor} and {target.relief.sensor}"
    few = min(source.relief.things, target.relief.things) < FEWEST_THINGS
    if not ranked:
        if few:
            return "too_little_structure", f"{names} see too few things on the belt to be matched."
        return "too_little_overlap", f"Nothing that {names} see fits together."
    best = ranked[0][0]
    said = best.evidence
    if said.agreeing >= ENOUGH_TO_TELL_MOVED and said.conflicting and _margin(ranked) >= LEAST_MARGIN:
        return _conflict(names, said)
    fewest = FEWEST_ON_TEXTURE if best.textured else FEWEST_THINGS
    if said.agreeing < fewest or best.support < LEAST_EVIDENCE or best.held is None:
        if few:
            return "too_little_structure", f"{names} see too few things on the belt to be matched."
        return "too_little_overlap", f"{names} have only {said.agreeing} things in common."
    if _margin(ranked) < LEAST_MARGIN:
        return "ambiguous", f"What {names} see fits together in two or more ways."
    if said.conflicting:
        return _conflict(names, said)
    if best.held.position_std_m > WORST_POSITION_STD_M or best.held.heading_std_rad > WORST_HEADING_STD_RAD:
        return "too_little_structure", (
            f"What {names} have in common holds them only to {1e3 * best.held.position_std_m:.1f} mm and "
            f"{np.degrees(best.held.heading_std_rad):.2f}°."
        )
    return None, ""


def _conflict(names: str, said: Evidence) -> tuple[Code, str]:
    if said.agreeing >= max(FEWEST_THINGS, 1.5 * said.conflicting):
        return "scene_moved", (
            f"{said.agreeing} things stand at the same place for {names}, but {said.conflicting} where the other "
            "sees empty belt: something was moved between their captures."
        )
    return "too_little_overlap", f"{names} have too little in common: {said.conflicting} things contradict the best."


def _refused(
    source: Ready, target: Ready, code: Code, what: str, ranked: list[tuple[Hypothesis, Shift]]
) -> Registration:
    best, start = ranked[0] if ranked else (None, None)
    return Registration(
        source.relief.sensor,
        target.relief.sensor,
        code,
        what,
        best,
        start,
        None,
        _quality(source, target, ranked, accepted=False),
    )


def _quality(source: Ready, target: Ready, ranked: list[tuple[Hypothesis, Shift]], *, accepted: bool) -> PairQuality:
    sensors = (source.relief.sensor, target.relief.sensor)
    if not ranked:
        return PairQuality(sensors, False, 0, 0.0, 0.0, 0.0, 1.0, inf, 0.0)
    best = ranked[0][0]
    matched = best.fit.matched
    residual = float(np.sqrt(np.average(matched.residual_m**2, weights=matched.weight)))
    scale = _scale(source.relief, target.relief, best.shift)
    return PairQuality(
        sensors=sensors,
        accepted=accepted,
        things=best.evidence.agreeing,
        overlap=overlap(source.relief, target, best.shift),
        residual_m=residual,
        held_out_m=fine.held_out_m(source.relief, best.fit),
        scale=scale.value,
        scale_std=scale.std,
        margin=_margin(ranked),
    )


def overlap(source: Relief, target: Ready, shift: Shift) -> float:
    """Return the share of the source's belt that lies in the target's picture."""
    points = source.background_m[np.abs(source.background_m[:, 2]) < 0.02]
    if not len(points):
        return 0.0
    verdict, _, _ = target.sight.judge(shift.apply(points))
    return float((verdict != 0).mean())


def _scale(source: Relief, target: Relief, shift: Shift) -> Scale:
    """Return how much farther apart matched tops are in the target than in the source."""
    if not (len(source.peaks_m) and len(target.peaks_m)):
        return Scale()
    mapped = shift.apply(source.peaks_m)[:, :2]
    gaps = np.linalg.norm(mapped[:, None] - target.peaks_m[None, :, :2], axis=2)
    met = gaps.min(axis=1) < 0.015
    return scale_between(mapped[met], target.peaks_m[gaps.argmin(axis=1)[met], :2])
