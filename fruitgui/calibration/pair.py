"""One pair of sensors: find the shift between them with no guess, or say why it cannot be told."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fruitgui.calibration import borders, coarse, fine
from fruitgui.calibration import lines as rails
from fruitgui.calibration.evidence import Evidence, Sight, evidence
from fruitgui.calibration.fine import Fit, Target
from fruitgui.calibration.flat import Shift
from fruitgui.calibration.lines import Turn
from fruitgui.calibration.relief import Relief
from fruitgui.calibration.result import Code, PairQuality
from fruitgui.frame import F64

QUICK_M = (0.03, 0.03, 0.03, 0.02, 0.015, 0.012)
DIFFERENT_M, DIFFERENT_RAD = 0.008, float(np.radians(0.7))
SURELY_SAME_RAD = float(np.radians(0.3))
FEWEST_THINGS = 3
ENOUGH_TO_TELL_MOVED = 5
LEAST_EVIDENCE = 22.0
LEAST_MARGIN = 12.0
WORST_POSITION_STD_M = 0.0015
WORST_HEADING_STD_RAD = float(np.radians(0.15))


class Ready:
    """One relief with what both roles in a pair need, built once per sensor."""

    def __init__(self, relief: Relief) -> None:
        self.relief = relief
        self.sight = Sight(relief)
        self.target = Target(relief)
        self.thin = _thinned(relief, 6)
        self.lines = rails.lines(relief)
        self.borders = borders.borders(relief)


@dataclass(frozen=True, slots=True, eq=False)
class Hypothesis:
    """A shift with its fit and what speaks for it."""

    fit: Fit
    evidence: Evidence

    @property
    def shift(self) -> Shift:
        """The shift, source's belt frame → target's."""
        return self.fit.shift


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
    ranked = _ranked(source, target, expected)
    code, what = _verdict(source, target, ranked)
    if code is not None:
        return _refused(source, target, code, what, ranked)
    best, start = ranked[0]
    best, covariance = _held_by_lines(source, target, best)
    covariance = about_origin(covariance, best.fit.matched.centre_m)
    return Registration(
        source.relief.sensor,
        target.relief.sensor,
        None,
        "",
        best,
        start,
        covariance,
        _quality(source, target, ranked, accepted=True),
    )


def about_origin(covariance: F64, centre_m: F64) -> F64:
    """Carry the (3, 3) covariance of (x, y, θ about a centre) to a turn about the origin."""
    J = np.eye(3)
    J[0, 2], J[1, 2] = centre_m[1], -centre_m[0]
    return np.asarray(J @ covariance @ J.T)


def _held_by_lines(source: Ready, target: Ready, best: Hypothesis) -> tuple[Hypothesis, F64]:
    """Return the best fit with its heading settled by borders or rails that both see, and its covariance.

    The covariance is of (x, y, θ about the centre of what is matched). With the heading settled, the shift is
    fitted anew: what the fruit's own heading erred would else stay in it. A line that contradicts the fruit by more
    than four standard deviations, and more than lines that lie so near each other ever do, is not the same line.
    """
    covariance = fine.covariance(source.relief, target.relief, best.fit)
    turn = _turn(source, target, best.shift)
    if turn is None or turn.turn_rad**2 > max(16 * (covariance[2, 2] + turn.std_rad**2), SURELY_SAME_RAD**2):
        return best, covariance
    share = covariance[2, 2] / (covariance[2, 2] + turn.std_rad**2)
    turned = best.shift.about(best.fit.matched.centre_m, np.array([0.0, 0.0, share * turn.turn_rad]))
    fit = fine.settle(source.relief, target.target, turned)
    if fit is None:
        return best, covariance
    held = np.zeros((3, 3))
    held[:2, :2] = fine.covariance(source.relief, target.relief, fit, turning=False)[:2, :2]
    held[2, 2] = (1.0 - share) * covariance[2, 2]
    return replace(best, fit=fit), held


def _turn(source: Ready, target: Ready, shift: Shift) -> Turn | None:
    """Return what straight things say of a heading: borders in the colour pictures, else rails in the depth."""
    seen = borders.turn_between(source.borders, target.borders, shift)
    return rails.turn_between(source.lines, target.lines, shift) if seen is None else seen


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
        for hypothesis, _ in _tried(source, target, [found.shift], source.relief, fine.SCHEDULE_M)
    ]
    return _different(source.relief, refined)


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
        return ranked[0][0].evidence.log_likelihood
    return ranked[0][0].evidence.log_likelihood - ranked[1][0].evidence.log_likelihood


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
    if said.agreeing < FEWEST_THINGS or said.log_likelihood < LEAST_EVIDENCE:
        if few:
            return "too_little_structure", f"{names} see too few things on the belt to be matched."
        return "too_little_overlap", f"{names} have only {said.agreeing} things in common."
    if _margin(ranked) < LEAST_MARGIN:
        return "ambiguous", f"What {names} see fits together in two or more ways."
    if said.conflicting:
        return _conflict(names, said)
    _, covariance = _held_by_lines(source, target, best)
    position = float(np.sqrt(covariance[0, 0] + covariance[1, 1]))
    if position > WORST_POSITION_STD_M or covariance[2, 2] > WORST_HEADING_STD_RAD**2:
        return "too_little_structure", (
            f"What {names} have in common holds them only to {1e3 * position:.1f} mm and "
            f"{np.degrees(np.sqrt(covariance[2, 2])):.2f}°."
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
        return PairQuality(sensors, False, 0, 0.0, 0.0, 0.0, 1.0, 0.0)
    best = ranked[0][0]
    matched = best.fit.matched
    residual = float(np.sqrt(np.average(matched.residual_m**2, weights=matched.weight)))
    return PairQuality(
        sensors=sensors,
        accepted=accepted,
        things=best.evidence.agreeing,
        overlap=overlap(source.relief, target, best.shift),
        residual_m=residual,
        held_out_m=fine.held_out_m(source.relief, best.fit),
        scale=_scale(source.relief, target.relief, best.shift),
        margin=_margin(ranked),
    )


def overlap(source: Relief, target: Ready, shift: Shift) -> float:
    """Return the share of the source's belt that lies in the target's picture."""
    points = source.background_m[np.abs(source.background_m[:, 2]) < 0.02]
    if not len(points):
        return 0.0
    verdict, _, _ = target.sight.judge(shift.apply(points))
    return float((verdict != 0).mean())


def _scale(source: Relief, target: Relief, shift: Shift) -> float:
    """Return how much farther apart matched tops are in the target than in the source."""
    if not (len(source.peaks_m) and len(target.peaks_m)):
        return 1.0
    mapped = shift.apply(source.peaks_m)[:, :2]
    gaps = np.linalg.norm(mapped[:, None] - target.peaks_m[None, :, :2], axis=2)
    near = gaps.argmin(axis=1)
    met = gaps.min(axis=1) < 0.015
    if met.sum() < 4:
        return 1.0
    a, b = mapped[met], target.peaks_m[near[met], :2]
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    return float((a * b).sum() / (a * a).sum())


def _thinned(relief: Relief, step: int) -> Relief:
    return replace(
        relief,
        points_m=relief.points_m[::step],
        normals=relief.normals[::step],
        colors=relief.colors[::step],
        thing=relief.thing[::step],
    )
