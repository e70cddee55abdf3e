"""Straight borders in the colour picture, of belt and rails: they tell a heading better than anything else in view.

A straight edge parallel to the belt casts, from the sensor's eye onto the belt's plane, a line parallel to itself
whatever its height (the plane cuts the sheet of rays parallel to it). So directions of borders are read off the
colour picture, whose edges are sharp to a fraction of a pixel, with no depth; fattened depth edges are an order worse.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration.flat import Shift, wrapped
from fruitgui.calibration.lines import Turn
from fruitgui.calibration.relief import Relief
from fruitgui.frame import F32, F64, Ints

SHORTEST_M = 0.35
SHORTEST_SEGMENT_M = 0.06
SEGMENT_RAD = float(np.radians(1.5))
SAME_EDGE_M = 0.003
STRAIGHT_M = 0.001
BIN_M = 0.04
REACH_PX = 4.0
FARTHEST_M = 2.5
SAME_BORDER_M = 0.08
"""Edges of one rail stand at several heights; seen from the side they fall this far apart on the belt."""

SAME_BORDER_RAD = float(np.radians(1.0))
FLOOR_RAD = float(np.radians(0.012))
"""What a lens bends unnoticed along one border: 0.1 px in 300."""


@dataclass(frozen=True, slots=True, eq=False)
class Border:
    """One straight edge on the belt's plane, in the belt's frame.

    Attributes:
        centre_m: (2,) its middle.
        direction: (2,) unit vector along it, of either sign.
        std_rad: of its direction.
        half_m: half its length.
    """

    centre_m: F64
    direction: F64
    std_rad: float
    half_m: float


def borders(relief: Relief) -> list[Border]:
    """Return the long straight edges of the colour picture, laid on the belt."""
    grey = cv2.cvtColor(relief.still.color, cv2.COLOR_RGB2GRAY)
    found = cv2.createLineSegmentDetector().detect(grey)[0]
    if found is None:
        return []
    segments = found.reshape(-1, 2, 2).astype(np.float64)
    ends, ahead = _on_belt(relief, segments)
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    near = ahead.all(axis=1) & (np.abs(ends).max(axis=(1, 2)) < FARTHEST_M) & (length > SHORTEST_SEGMENT_M)
    segments, ends = segments[near], ends[near]
    smooth = cv2.GaussianBlur(grey.astype(np.float32), (0, 0), 0.7).astype(np.float32)
    groups = _collinear(ends)
    return [one for group in groups if (one := _border(relief, smooth, segments[group])) is not None]


def _on_belt(relief: Relief, pixels: F64) -> tuple[F64, F64]:
    """Return where the rays of pixels (…, 2) meet the belt, (…, 2), and whether they do so ahead of the sensor."""
    rays = _rays_at(relief, pixels)
    frame = relief.frame
    along = rays @ frame.rotation.T
    origin = frame.translation_m
    ahead = along[..., 2] < -0.1 * np.linalg.norm(along, axis=-1)
    reach = -origin[2] / np.where(ahead, along[..., 2], -1.0)
    return origin[:2] + reach[..., None] * along[..., :2], ahead


def _rays_at(relief: Relief, pixels: F64) -> F64:
    """Return rays (…, 3) with z = 1 through pixels (…, 2) between the centres of pixels."""
    rays = relief.still.intrinsics.rays()
    u, v = (pixels[..., k].reshape(1, -1).astype(np.float32) for k in (0, 1))
    found = cv2.remap(rays, u, v, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    flat = found.reshape(*pixels.shape[:-1], 2).astype(np.float64)
    return np.concatenate([flat, np.ones((*flat.shape[:-1], 1))], axis=-1)


def _collinear(ends: F64) -> list[Ints]:
    """Return groups of segments that lie on one line, those with the longest members first."""
    along = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(along, axis=1)
    unit = along / np.maximum(length, 1e-9)[:, None]
    left = np.ones(len(ends), dtype=bool)
    groups: list[Ints] = []
    for seed in np.argsort(-length):
        if not left[seed]:
            continue
        normal = np.array([-unit[seed, 1], unit[seed, 0]])
        off = np.abs((ends - ends[seed].mean(axis=0)) @ normal).max(axis=1)
        bound = SAME_EDGE_M if length[seed] > SHORTEST_M else 2 * SAME_EDGE_M
        same = left & (off < bound) & (np.abs(unit @ unit[seed]) > np.cos(SEGMENT_RAD))
        left &= ~same
        groups.append(np.nonzero(same)[0].astype(np.intp))
    return groups


def _border(relief: Relief, grey: F32, segments: F64) -> Border | None:
    """Return the line through a group's edge points, found anew to a fraction of a pixel; None if short or bent."""
    pixels = np.concatenate([_edge_points(grey, one) for one in segments])
    if len(pixels) < 20:
        return None
    points, _ = _on_belt(relief, pixels)
    centre = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - centre, full_matrices=False)
    along, across = ((points - centre) @ axes.T).T
    bins = np.floor((along - along.min()) / BIN_M).astype(int)
    count = np.bincount(bins)
    good = count >= 4
    if good.sum() * BIN_M < 0.6 * SHORTEST_M or np.ptp(along) < SHORTEST_M:
        return None
    middle = np.array([np.median(across[bins == k]) for k in np.nonzero(good)[0]])
    place = np.array([along[bins == k].mean() for k in np.nonzero(good)[0]])
    return _fitted(place, middle, centre, axes)


def _fitted(place: F64, middle: F64, centre: F64, axes: F64) -> Border | None:
    """Return the line through bins at `place` along and `middle` across `axes`; None where too few lie straight."""
    kept = np.ones(len(place), dtype=bool)
    slope = start = 0.0
    for bound in (0.006, 0.003, 2 * STRAIGHT_M):
        if kept.sum() * BIN_M < 0.6 * SHORTEST_M or np.ptp(place[kept]) < SHORTEST_M:
            return None
        slope, start = np.polyfit(place[kept], middle[kept], 1)
        kept = np.abs(middle - slope * place - start) < bound
    residual = (middle - slope * place - start)[kept]
    if kept.sum() < 6 or residual.std() > STRAIGHT_M or np.ptp(place[kept]) < SHORTEST_M:
        return None
    arm = place[kept] - place[kept].mean()
    # Neighbouring bins share what bends them: three in a row count as one.
    std = float(np.sqrt(3.0) * max(residual.std(), 5e-5) / np.linalg.norm(arm))
    direction = axes[0] + slope * axes[1]
    middle_m = float(place[kept].max() + place[kept].min()) / 2
    on = centre + middle_m * axes[0] + (slope * middle_m + start) * axes[1]
    return Border(on, direction / np.linalg.norm(direction), std, float(np.ptp(place[kept])) / 2)


def _edge_points(grey: F32, segment: F64, step_px: float = 1.5) -> F64:
    """Return points (N, 2) of the edge along a segment, from the centroid of the gradient across it."""
    along = segment[1] - segment[0]
    length = float(np.linalg.norm(along))
    along = along / length
    normal = np.array([-along[1], along[0]])
    at = segment[0] + np.arange(3.0, length - 3.0, step_px)[:, None] * along
    offsets = np.arange(-REACH_PX, REACH_PX + 0.25, 0.5)
    grid = at[:, None] + offsets[:, None] * normal
    if not len(at):
        return np.zeros((0, 2))
    profile = cv2.remap(grey, grid[..., 0].astype(np.float32), grid[..., 1].astype(np.float32), cv2.INTER_LINEAR)
    profile = cv2.blur(profile, (1, 9))  # along the edge
    slope = np.diff(profile, axis=1)
    slope = slope * np.sign(slope[:, len(offsets) // 2 - 3 : len(offsets) // 2 + 3].sum())
    middle = (offsets[1:] + offsets[:-1]) / 2
    weight = np.clip(slope - 0.4 * slope.max(axis=1, keepdims=True), 0.0, None)
    weight *= np.abs(middle) < 2.0
    total = weight.sum(axis=1)
    strong = (slope.max(axis=1) > 1.0) & (total > 0)
    off = (weight[strong] * middle).sum(axis=1) / total[strong]
    return np.asarray(at[strong] + off[:, None] * normal)


def turn_between(source: list[Border], target: list[Border], shift: Shift) -> Turn | None:
    """Return how much must be added to a shift's heading for the borders that both see to be parallel.

    Only edges of one rail are held against each other, so rails need not be parallel, but straight.
    """
    turns = [turn for a in source for b in target if (turn := _one_turn(a, b, shift)) is not None]
    if not turns:
        return None
    value = np.array([turn.turn_rad for turn in turns])
    weight = np.array([1 / (turn.std_rad**2 + FLOOR_RAD**2) for turn in turns])
    best = value[np.argmin((np.abs(value[:, None] - value) * weight).sum(axis=1))]
    weight /= 1.0 + ((value - best) / np.radians(0.06)) ** 2
    mean = float((weight * value).sum() / weight.sum())
    scatter = float(np.sqrt((weight * (value - mean) ** 2).sum() / weight.sum()))
    few = np.sqrt(min(len(source), len(target), 4))
    return Turn(mean, float(np.hypot(FLOOR_RAD, max(scatter, float(np.min([t.std_rad for t in turns]))) / few)))


def heading_between(source: list[Border], target: list[Border]) -> float | None:
    """Return the heading, but for half a circle, under which the borders of two sensors run the same way."""
    mine, theirs = _common_direction(source), _common_direction(target)
    return None if mine is None or theirs is None else wrapped(theirs - mine)


def _common_direction(found: list[Border]) -> float | None:
    """Return the direction that most borders share."""
    if not found:
        return None
    twice = 2 * np.array([np.arctan2(one.direction[1], one.direction[0]) for one in found])
    apart = np.abs((twice[:, None] - twice + np.pi) % (2 * np.pi) - np.pi)
    most = int((apart < 2 * SAME_BORDER_RAD).sum(axis=1).argmax())
    like = apart[most] < 2 * SAME_BORDER_RAD
    return float(np.arctan2(np.sin(twice[like]).sum(), np.cos(twice[like]).sum()) / 2)


def _one_turn(a: Border, b: Border, shift: Shift) -> Turn | None:
    centre, direction = shift.apply(a.centre_m), shift.rotation @ a.direction
    apart = float(np.abs((centre - b.centre_m) @ np.array([-b.direction[1], b.direction[0]])))
    turn = wrapped(2 * float(np.arctan2(direction[0] * b.direction[1] - direction[1] * b.direction[0],
                                        direction @ b.direction))) / 2  # fmt: skip
    if apart > SAME_BORDER_M or abs(turn) > SAME_BORDER_RAD:
        return None
    return Turn(turn, float(np.hypot(a.std_rad, b.std_rad)))
