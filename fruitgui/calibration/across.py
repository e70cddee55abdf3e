"""How two sensors stand across straight edges that both see in colour: belt's ends and rims of rails, at their height.

An edge in the colour picture is sharp where depth is stepped, noisy and fattened. Depth only says at which of few
heights it runs, the belt's or a rail's top; cast onto the level of that height, one edge lies at one place for both
sensors. It tells nothing of where they stand along it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import cv2
import numpy as np

from fruitgui.calibration.borders import Border
from fruitgui.calibration.flat import Shift
from fruitgui.calibration.lines import Line
from fruitgui.calibration.relief import Relief
from fruitgui.frame import F32, F64

BESIDE_PX = (2.5, 5.0)
"""How far from an edge its sides are looked at, at 640 pixels across."""

SAME_HEIGHT_M = 0.006
LOW_SHARE = 0.5
"""Beside a belt's edge nothing rises above this share of a rail's height so near to it."""

NEAR_TOP_M = 0.06
SAME_TOP_M = 0.005
TOP_STD_M = 0.0004
EDGE_STD_PX = 0.1
"""What lens, tone curve and shading move an edge by, unnoticed."""

LEAST_COMMON_M = 0.1
LEAST_SEEN = 0.25
PARALLEL = float(np.cos(np.radians(2.0)))
WITHIN_STDS, WITHIN_M = 4.0, 0.0015
AGREE_M = 0.001
FEWEST_EDGES = 2


@dataclass(frozen=True, slots=True, eq=False)
class Brink:
    """A border with the heights (m) over the belt at which it may run."""

    border: Border
    heights_m: tuple[float, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Across:
    """By how much a shift must move the source across edges.

    Attributes:
        normal: (2,) unit vector across, target's frame.
        at_m: (2,) where that is so.
        gap_m, std_m: how far along the normal, and how sure.
        edges: how many edges say so.
    """

    normal: F64
    at_m: F64
    gap_m: float
    std_m: float
    edges: int


@dataclass(frozen=True, slots=True, eq=False)
class _Meeting:
    """One border of the source laid on one of the target, at one height."""

    pair: tuple[int, int]
    normal: F64
    at_m: F64
    gap_m: float
    std_m: float


def brinks(relief: Relief, borders: Sequence[Border], lines: Sequence[Line]) -> list[Brink]:
    """Return the borders of whose height the depth beside them says something."""
    over = relief.frame.apply(relief.still.points())[..., 2]
    height_m = np.where(relief.still.seen, over, np.nan).astype(np.float32)
    found = []
    for border in borders:
        beside = _beside(relief, height_m, border)
        tops = [line.height_m for line in lines if _is_near(relief, border, line)]
        heights = _heights(beside, tops)
        if heights:
            found.append(Brink(border, heights))
    return found


def _is_near(relief: Relief, border: Border, line: Line) -> bool:
    at = raised(relief, border.centre_m, line.height_m)
    normal = np.array([-border.direction[1], border.direction[0]])
    return float(np.abs(np.median((line.places_m - at) @ normal))) < NEAR_TOP_M


def _heights(beside: float, tops: Sequence[float]) -> tuple[float, ...]:
    """Return at which heights an edge may run beside which depth reads so high (m)."""
    heights = [top for top in tops if abs(beside - top) < SAME_HEIGHT_M]
    low = beside < max(LOW_SHARE * min(tops, default=0.0), SAME_HEIGHT_M)
    return (*heights, 0.0) if low else tuple(heights)


def raised(relief: Relief, place_m: F64, height_m: float) -> F64:
    """Return where the ray that meets the belt at a place (2,) passes a height."""
    eye = relief.frame.translation_m
    return np.asarray(eye[:2] + (place_m - eye[:2]) * (1.0 - height_m / eye[2]))


def _beside(relief: Relief, height_m: F32, border: Border) -> float:
    """Return the height (m) on the higher side of a border, a few pixels off; NaN where neither is seen."""
    at = border.centre_m + np.linspace(-border.half_m, border.half_m, 120)[:, None] * border.direction
    flat = np.hstack([at, np.zeros((len(at), 1))])
    pixels = relief.still.intrinsics.project(relief.frame.inverse().apply(flat))
    along = np.gradient(pixels, axis=0)
    across_px = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.maximum(np.hypot(*along.T), 1e-9)[:, None]
    off = np.linspace(*BESIDE_PX, 4)[:, None, None] * relief.still.intrinsics.width / 640
    sides = [_read(height_m, pixels + sign * off * across_px) for sign in (-1.0, 1.0)]
    return max((side for side in sides if np.isfinite(side)), default=float("nan"))


def _read(height_m: F32, spots: F64) -> float:
    """Return the median height at pixels (…, 2); NaN where few are seen."""
    u, v = (spots[..., k].astype(np.float32) for k in (0, 1))
    read = cv2.remap(height_m, u, v, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=float("nan"))
    seen = np.isfinite(read)
    return float(np.median(read[seen])) if seen.mean() > LEAST_SEEN else float("nan")


def across(
    source: tuple[Relief, Sequence[Brink]], target: tuple[Relief, Sequence[Brink]], shift: Shift, std_m: float
) -> Across | None:
    """Return how far a shift, unsure by `std_m`, must move the source across edges; None where they do not tell.

    At least two edges must say the same, and no others as many that is something else.
    """
    met = _meetings(source, target, shift)
    met = [one for one in met if abs(one.gap_m) < WITHIN_STDS * np.hypot(std_m, one.std_m) + WITHIN_M]
    if not met:
        return None
    main = max(met, key=lambda one: sum(abs(one.normal @ other.normal) > PARALLEL for other in met)).normal
    said = [_mean(_agreeing(one, met), main) for one in met if abs(one.normal @ main) > PARALLEL]
    best = max(said, key=lambda one: one.edges)
    rivals = [one for one in said if one.edges >= best.edges and abs(one.gap_m - best.gap_m) > AGREE_M]
    return None if rivals or best.edges < FEWEST_EDGES else best


def _edges(group: Sequence[_Meeting]) -> int:
    return min(len({one.pair[k] for one in group}) for k in (0, 1))


def _agreeing(one: _Meeting, met: Sequence[_Meeting]) -> list[_Meeting]:
    return [other for other in met if abs(other.gap_m * np.sign(other.normal @ one.normal) - one.gap_m) < AGREE_M]


def _mean(group: Sequence[_Meeting], main: F64) -> Across:
    gaps = np.array([one.gap_m * np.sign(one.normal @ main) for one in group])
    weight = np.array([one.std_m**-2 for one in group])
    at = np.array([one.at_m for one in group])
    gap = float((weight * gaps).sum() / weight.sum())
    spread = float(np.sqrt((weight * (gaps - gap) ** 2).sum() / weight.sum()))
    edges = _edges(group)
    std = float(np.hypot(1.0 / np.sqrt(weight.mean() * min(edges, 2)), spread / np.sqrt(edges)))
    return Across(main, (weight[:, None] * at).sum(axis=0) / weight.sum(), gap, std, edges)


def _meetings(
    source: tuple[Relief, Sequence[Brink]], target: tuple[Relief, Sequence[Brink]], shift: Shift
) -> list[_Meeting]:
    met = []
    for (i, mine), (j, theirs) in product(enumerate(source[1]), enumerate(target[1])):
        for a, b in product(mine.heights_m, theirs.heights_m):
            if abs(a - b) < SAME_TOP_M and (a == 0.0) == (b == 0.0):
                one = _laid((source[0], mine.border), (target[0], theirs.border), shift, (a + b) / 2)
                met += [] if one is None else [_Meeting((i, j), *one)]
    return met


def _laid(
    source: tuple[Relief, Border], target: tuple[Relief, Border], shift: Shift, height_m: float
) -> tuple[F64, F64, float, float] | None:
    """Return normal, place, gap and its standard deviation of two borders held to be one edge at a height."""
    (mine, a), (theirs, b) = source, target
    on_a = shift.apply(raised(mine, a.centre_m, height_m))
    on_b = raised(theirs, b.centre_m, height_m)
    way_a, way_b = shift.rotation @ a.direction, b.direction
    if abs(way_a @ way_b) < PARALLEL:
        return None
    middle = float((on_a - on_b) @ way_b)
    low, high = max(-b.half_m, middle - a.half_m), min(b.half_m, middle + a.half_m)
    if high - low < LEAST_COMMON_M:
        return None
    at = on_b + (low + high) / 2 * way_b
    normal = np.array([-way_b[1], way_b[0]])
    gap = float((at - on_a - ((at - on_a) @ way_a) * way_a) @ normal)
    back = shift.inverse()
    lean = _lean(theirs, at, normal) - _lean(mine, back.apply(at), back.rotation @ normal)
    top = TOP_STD_M * lean if height_m > 0 else 0.0
    return normal, at, gap, float(np.sqrt(_variance(mine, back.apply(at)) + _variance(theirs, at) + top**2))


def _lean(relief: Relief, at_m: F64, normal: F64) -> float:
    """Return how far a place moves along a normal for each metre by which the height of its level errs."""
    eye = relief.frame.translation_m
    return float((at_m - eye[:2]) @ normal) / float(eye[2])


def _variance(relief: Relief, at_m: F64) -> float:
    """Return the variance (m²) across an edge of where it meets its level: of the edge, and of the belt's plane."""
    eye, spread = relief.frame.translation_m, relief.belt.covariance
    out = at_m - eye[:2]
    flat = float(out @ out) / eye[2] ** 2
    plane = spread[2, 2] + float(out @ out) * (spread[0, 0] + spread[1, 1]) / 2
    pixel_m = float(np.hypot(np.linalg.norm(out), eye[2])) / relief.still.intrinsics.fx
    return float(flat * plane / 2 + (EDGE_STD_PX * pixel_m) ** 2 * (1 + flat))
