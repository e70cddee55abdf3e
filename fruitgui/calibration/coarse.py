"""Where two sensors might stand to each other: hypotheses of shift and heading, found without a guess.

Two searches, because each finds what the other misses. Constellations: two tops
of things in one view against two in the other give a shift; the one under which
most tops meet tops, and none falls on empty belt, is likely. Plans: the maps of
what is empty and what is not, correlated over all headings and shifts by FFT;
it needs no separate things.
"""

from __future__ import annotations

import cv2
import numpy as np

from fruitgui.calibration.flat import Shift, best_shift, wrapped
from fruitgui.calibration.relief import EMPTY, RISEN, Ground, Relief
from fruitgui.frame import F64

PLAN_CELL_M = 0.016
HEADING_STEP_RAD = np.radians(4.0)
TOP_TOLERANCE_M = 0.02
HEIGHT_TOLERANCE_M = 0.012
HYPOTHESES = 12


def hypotheses(source: Relief, target: Relief) -> list[Shift]:
    """Return materially different shifts from the source's belt frame into the target's, best first."""
    found = from_constellations(source, target) + from_plans(source, target)
    at_m = source.peaks_m[:, :2] if len(source.peaks_m) else source.background_m[:, :2]
    return distinct(found, at_m, 0.02, np.radians(3.0))[: 2 * HYPOTHESES]


def along_borders(source: Relief, target: Relief, heading_rad: float, most: int = 5) -> list[Shift]:
    """Return shifts that turn by `heading_rad` or half a circle more and bring a top onto a top, best first.

    Where straight borders tell the heading, one top decides the rest: this finds views that have only a few things in
    common among many, which the other searches lose among chance meetings.
    """
    a, b = source.peaks_m, target.peaks_m
    if not (len(a) and len(b)):
        return []
    i, k = np.nonzero(np.abs(a[:, 2][:, None] - b[:, 2]) < HEIGHT_TOLERANCE_M)
    found = []
    for heading in (wrapped(heading_rad), wrapped(heading_rad + np.pi)):
        move = b[k, :2] - a[i, :2] @ Shift(0.0, 0.0, heading).rotation.T
        shifts = np.column_stack([move, np.full(len(move), heading)])
        order = np.argsort(-_convincing(shifts, source, target), kind="stable")[:60]
        near = [Shift(float(x), float(y), heading) for x, y in move[order]]
        found += distinct(near, a[:, :2], 0.02, np.radians(4.0))[:most]
    return found


def distinct(shifts: list[Shift], at_m: F64, apart_m: float, turned_rad: float) -> list[Shift]:
    """Drop every shift that differs from an earlier one by less than both bounds (rms over points (N, 2))."""
    if not shifts or not len(at_m):
        return shifts[:1]
    heading = np.array([shift.heading_rad for shift in shifts])
    centre = at_m.mean(axis=0)
    places = np.array([shift.apply(centre) for shift in shifts])
    radius = float(np.sqrt(((at_m - centre) ** 2).sum(axis=1).mean()))
    kept: list[int] = []
    for i in range(len(shifts)):
        turned = np.abs((heading[kept] - heading[i] + np.pi) % (2 * np.pi) - np.pi)
        far = np.hypot(np.linalg.norm(places[kept] - places[i], axis=1), 2 * radius * np.sin(turned / 2))
        if ((far > apart_m) | (turned > turned_rad)).all():
            kept.append(i)
    return [shifts[i] for i in kept]


def from_constellations(source: Relief, target: Relief) -> list[Shift]:
    """Return shifts under which two tops of each view meet, the most convincing first."""
    a, b = source.peaks_m, target.peaks_m
    if len(a) < 2 or len(b) < 2:
        return []
    ends = _matching_pairs(a, b)
    if len(ends) == 0:
        return []
    shifts = _shifts_of_pairs(a, b, ends)
    scores = _convincing(shifts, source, target)
    order = np.argsort(-scores, kind="stable")[:400]
    found = [Shift(float(x), float(y), float(heading)) for x, y, heading in shifts[order]]
    return [_onto_tops(shift, a, b) for shift in distinct(found, a[:, :2], 0.02, np.radians(4.0))[:HYPOTHESES]]


def _matching_pairs(a: F64, b: F64, most: int = 20000) -> F64:
    """Return (M, 4) indices i, j of source tops and k, l of target tops with like heights and like distance."""
    i, j = (index.ravel() for index in np.meshgrid(np.arange(len(a)), np.arange(len(a)), indexing="ij"))
    k, m = (index.ravel() for index in np.meshgrid(np.arange(len(b)), np.arange(len(b)), indexing="ij"))
    i, j = i[i != j], j[i != j]
    k, m = k[k != m], m[k != m]
    far_a = np.hypot(*(a[i, :2] - a[j, :2]).T)
    far_b = np.hypot(*(b[k, :2] - b[m, :2]).T)
    once = i < j  # each source pair in one order, target pairs in both
    i, j, far_a = i[once], j[once], far_a[once]
    like = np.abs(far_a[:, None] - far_b) < TOP_TOLERANCE_M
    like &= np.abs(a[i, 2][:, None] - b[k, 2]) < HEIGHT_TOLERANCE_M
    like &= np.abs(a[j, 2][:, None] - b[m, 2]) < HEIGHT_TOLERANCE_M
    like &= far_a[:, None] > 0.06
    rows, columns = np.nonzero(like)
    if len(rows) > most:
        longest = np.argsort(-far_a[rows], kind="stable")[:most]
        rows, columns = rows[longest], columns[longest]
    return np.stack([i[rows], j[rows], k[columns], m[columns]], axis=1)


def _shifts_of_pairs(a: F64, b: F64, ends: F64) -> F64:
    i, j, k, m = ends.T
    from_a, from_b = a[j, :2] - a[i, :2], b[m, :2] - b[k, :2]
    heading = np.arctan2(from_b[:, 1], from_b[:, 0]) - np.arctan2(from_a[:, 1], from_a[:, 0])
    c, s = np.cos(heading), np.sin(heading)
    middle_a, middle_b = (a[i, :2] + a[j, :2]) / 2, (b[k, :2] + b[m, :2]) / 2
    x = middle_b[:, 0] - (c * middle_a[:, 0] - s * middle_a[:, 1])
    y = middle_b[:, 1] - (s * middle_a[:, 0] + c * middle_a[:, 1])
    return np.stack([x, y, heading], axis=1)


def _convincing(shifts: F64, source: Relief, target: Relief) -> F64:
    """Return tops that meet tops less twice the tops that fall on empty belt, both ways, for shifts (M, 3)."""
    forward = _meetings(shifts, source.peaks_m, target.peaks_m, target.ground)
    c, s = np.cos(shifts[:, 2]), np.sin(shifts[:, 2])
    back = np.stack(
        [-(c * shifts[:, 0] + s * shifts[:, 1]), s * shifts[:, 0] - c * shifts[:, 1], -shifts[:, 2]], axis=1
    )
    return forward + _meetings(back, target.peaks_m, source.peaks_m, source.ground)


def _meetings(shifts: F64, a: F64, b: F64, ground: Ground) -> F64:
    scores = np.zeros(len(shifts))
    for start in range(0, len(shifts), 2000):
        part = slice(start, start + 2000)
        c, s = np.cos(shifts[part, 2])[:, None], np.sin(shifts[part, 2])[:, None]
        x = c * a[:, 0] - s * a[:, 1] + shifts[part, 0][:, None]
        y = s * a[:, 0] + c * a[:, 1] + shifts[part, 1][:, None]
        squared = (x[..., None] - b[:, 0]) ** 2 + (y[..., None] - b[:, 1]) ** 2
        squared += np.where(np.abs(a[:, 2][:, None] - b[:, 2]) < HEIGHT_TOLERANCE_M, 0.0, 1.0)
        closeness = np.clip(1.0 - squared.min(axis=2) / (1.5 * TOP_TOLERANCE_M) ** 2, 0.0, None)
        on_empty = (ground.at(np.stack([x, y], axis=-1)) == EMPTY) & (closeness == 0)
        scores[part] = closeness.sum(axis=1) - 2.0 * on_empty.sum(axis=1)
    return scores


def _onto_tops(shift: Shift, a: F64, b: F64) -> Shift:
    """Return the shift improved by least squares over the tops that meet."""
    for _ in range(3):
        mapped = shift.apply(a)
        squared = ((mapped[:, None, :2] - b[None, :, :2]) ** 2).sum(axis=2)
        squared += np.where(np.abs(a[:, 2][:, None] - b[:, 2]) < HEIGHT_TOLERANCE_M, 0.0, 1.0)
        near = squared.argmin(axis=1)
        met = squared.min(axis=1) < (1.5 * TOP_TOLERANCE_M) ** 2
        if met.sum() < 2:
            return shift
        shift = best_shift(a[met, :2], b[near[met], :2])
    return shift


def from_plans(source: Relief, target: Relief) -> list[Shift]:
    """Return shifts under which the two plans agree best, by correlation over all headings and shifts."""
    from scipy import fft

    plan_a, low_a = _plan(target.ground)
    plan_b, low_b = _plan(source.ground)
    if not (plan_a[0].any() and plan_b[0].any()):
        return []
    side = int(np.ceil(np.hypot(*plan_b[0].shape))) + 2
    shape = tuple(fft.next_fast_len(n + side, real=True) for n in plan_a[0].shape)
    risen_a, height_a, against_a = plan_a
    filters = [fft.rfft2(f, shape) for f in (risen_a - against_a, 2 * height_a, -risen_a)]
    found: list[tuple[float, Shift]] = []
    for heading in np.arange(-np.pi, np.pi, HEADING_STEP_RAD):
        turned, origin = _turned(plan_b, low_b, heading, side)
        spectrum = sum(f * np.conj(fft.rfft2(t, shape)) for f, t in zip(filters, turned, strict=True))
        score = fft.irfft2(spectrum, shape)
        found += _summits(score, heading, low_a - origin)
    found.sort(key=lambda entry: -entry[0])
    at_m = source.ground.low_m + source.ground.cell_m * np.argwhere(source.ground.state == RISEN)[::20, ::-1]
    return distinct([shift for _, shift in found[:200]], at_m, 0.03, np.radians(6.0))[:HYPOTHESES]


def _plan(ground: Ground) -> tuple[list[F64], F64]:
    """Return coarse maps (risen, height, against) of a plan, and the corner of their cell (0, 0).

    With heights in units of 20 mm, risen·risen − (difference of heights)² − 1 for risen on empty is a sum of
    products of these maps.
    """
    v, u = np.nonzero(ground.state)
    coarse = (np.stack([u, v], axis=1) * (ground.cell_m / PLAN_CELL_M)).astype(int)
    shape = tuple(coarse.max(axis=0)[::-1] + 1) if len(coarse) else (1, 1)
    empty, height = np.zeros(shape, np.float32), np.zeros(shape, np.float32)
    states = ground.state[v, u]
    empty[coarse[states == EMPTY, 1], coarse[states == EMPTY, 0]] = 1.0
    np.maximum.at(height, (coarse[:, 1], coarse[:, 0]), ground.height_m[v, u].astype(np.float32) / 0.02)
    risen = (height > 0).astype(np.float32)
    empty[risen > 0] = 0.0
    return [risen, height, height**2 + empty], ground.low_m


def _turned(plan: list[F64], low_m: F64, heading: float, side: int) -> tuple[list[F64], F64]:
    """Return the maps turned by `heading` about the plan's middle, and where their cell (0, 0) then lies."""
    rows, columns = plan[0].shape
    middle = np.array([columns / 2, rows / 2])
    R = Shift(0.0, 0.0, heading).rotation
    matrix = np.hstack([R, (np.array([side / 2, side / 2]) - R @ middle)[:, None]])
    turned = [cv2.warpAffine(layer, matrix, (side, side), flags=cv2.INTER_NEAREST) for layer in plan]
    middle_m = R @ (low_m + middle * PLAN_CELL_M)
    return turned, middle_m - side / 2 * PLAN_CELL_M


def _summits(score: F64, heading: float, offset_m: F64, most: int = 2) -> list[tuple[float, Shift]]:
    """Return the highest places of one correlation map as shifts; indices past the middle wrap to negative."""
    rows, columns = score.shape
    score = score.copy()
    found = []
    for _ in range(most):
        v, u = np.unravel_index(int(score.argmax()), score.shape)
        value = float(score[v, u])
        if value <= 0:
            break
        dv, du = (v if v < rows / 2 else v - rows), (u if u < columns / 2 else u - columns)
        x, y = offset_m + np.array([du, dv]) * PLAN_CELL_M
        found.append((value, Shift(float(x), float(y), wrapped(heading))))
        score[np.ix_(np.arange(v - 3, v + 4) % rows, np.arange(u - 3, u + 4) % columns)] = -np.inf
    return found
