"""Long straight things beside the belt, rails above all: they tell the heading better than a few fruit do.

Only their direction is used. Where exactly a rail's edge lies depends on how far a sensor
fattens edges; that moves the whole line, or both sides of its top by as much, and turns nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration.flat import Shift, wrapped
from fruitgui.calibration.relief import RISEN, Ground, Relief
from fruitgui.frame import F64, Bools, Ints

SHORTEST_M = 0.4
BIN_M = 0.02
STRAIGHT_M = 0.002
SAME_LINE_M = 0.025
SAME_LINE_RAD = float(np.radians(1.5))
FLOOR_RAD = float(np.radians(0.025))
"""Fattening that changes along a line as its distance does turns it by up to this (2 px, line 10° off)."""


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """The middle of the top of one long straight thing, in the belt's frame: places (N, 2) along it, and its height."""

    places_m: F64
    height_m: float


@dataclass(frozen=True, slots=True)
class Turn:
    """What lines say about a heading: how much to add to it, and how sure that is."""

    turn_rad: float
    std_rad: float


def lines(relief: Relief) -> list[Line]:
    """Return the long straight things that rise above the belt beside what stands on it."""
    return [line for points in _long_patches(relief) if (line := _line(points)) is not None]


def _long_patches(relief: Relief) -> list[F64]:
    ground = relief.ground
    raised = (ground.state == RISEN).astype(np.uint8)
    count, names, stats, _ = cv2.connectedComponentsWithStats(cv2.dilate(raised, np.ones((3, 3), np.uint8)))
    lengths = np.hypot(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]) * ground.cell_m
    points = relief.frame.apply(relief.still.points()[::2, ::2])
    inside = relief.still.seen[::2, ::2] & (points[..., 2] > 0.008) & (points[..., 2] < 0.3)
    found = points[inside]
    name = _names_at(ground, names, found[:, :2])
    return [found[name == k] for k in range(1, count) if lengths[k] > SHORTEST_M]


def _names_at(ground: Ground, names: Ints, xy_m: F64) -> Ints:
    index = np.floor((xy_m - ground.low_m) / ground.cell_m).astype(int)
    rows, columns = names.shape
    inside = (index >= 0).all(axis=1) & (index[:, 0] < columns) & (index[:, 1] < rows)
    index = np.where(inside[:, None], index, 0)
    return np.where(inside, names[index[:, 1], index[:, 0]], 0)


def _line(points: F64) -> Line | None:
    """Return the middle of the top of a patch, bin by bin along it; None where it is no straight line."""
    if len(points) < 200:
        return None
    top = float(np.percentile(points[:, 2], 85))
    for _ in range(3):
        top = float(np.median(points[np.abs(points[:, 2] - top) < 0.007, 2]))
    points = points[np.abs(points[:, 2] - top) < 0.007]
    centre = points[:, :2].mean(axis=0)
    _, _, axes = np.linalg.svd((points[:, :2] - centre)[:: max(1, len(points) // 2000)], full_matrices=False)
    along, across = (points[:, :2] - centre) @ axes.T[:, 0], (points[:, :2] - centre) @ axes.T[:, 1]
    bins = np.floor(along / BIN_M).astype(int)
    bins -= bins.min()
    count = np.bincount(bins)
    middle = np.divide(np.bincount(bins, across), count, out=np.zeros(len(count)), where=count > 0)
    place = np.divide(np.bincount(bins, along), count, out=np.zeros(len(count)), where=count > 0)
    good = count >= max(4, 0.4 * float(np.median(count[count > 0])))
    kept = _straight(place[good], middle[good])
    if kept is None:
        return None
    places = np.stack([place[good][kept], middle[good][kept]], axis=1)
    return Line(places @ axes + centre, top)


def _straight(place: F64, middle: F64) -> Bools | None:
    """Return which bins lie on one straight line; None where too few do."""
    kept: Bools = np.ones(len(place), dtype=bool)
    slope = start = 0.0
    for bound in (0.02, 0.008, 3 * STRAIGHT_M):
        if kept.sum() < SHORTEST_M / BIN_M * 0.6:
            return None
        slope, start = np.polyfit(place[kept], middle[kept], 1)
        kept = np.abs(middle - slope * place - start) < bound
    residual = (middle - slope * place - start)[kept]
    long = kept.sum() >= SHORTEST_M / BIN_M * 0.6 and np.ptp(place[kept]) > SHORTEST_M
    return kept if long and residual.std() < STRAIGHT_M else None


def turn_between(source: list[Line], target: list[Line], shift: Shift) -> Turn | None:
    """Return how much must be added to a shift's heading for the lines that both see to be parallel."""
    turns = [turn for a in source for b in target if (turn := _one_turn(shift.apply(a.places_m), b.places_m))]
    if not turns:
        return None
    weight = np.array([1 / turn.std_rad**2 for turn in turns])
    value = float((weight * [turn.turn_rad for turn in turns]).sum() / weight.sum())
    return Turn(value, float(np.hypot(1 / np.sqrt(weight.sum()), FLOOR_RAD)))


def _one_turn(a: F64, b: F64) -> Turn | None:
    """Return the turn from line a to line b over the stretch that both cover; None where they are not one line."""
    direction = _direction(b)
    along_a, along_b = (a - b.mean(axis=0)) @ direction, (b - b.mean(axis=0)) @ direction
    low, high = max(along_a.min(), along_b.min()), min(along_a.max(), along_b.max())
    a, b = a[(along_a >= low) & (along_a <= high)], b[(along_b >= low) & (along_b <= high)]
    if high - low < SHORTEST_M or min(len(a), len(b)) < 10:
        return None
    apart = float(np.abs((a.mean(axis=0) - b.mean(axis=0)) @ np.array([-direction[1], direction[0]])))
    turn = wrapped(2 * (_angle(b) - _angle(a))) / 2
    if apart > SAME_LINE_M or abs(turn) > SAME_LINE_RAD:
        return None
    return Turn(turn, float(np.hypot(_angle_std(a), _angle_std(b))))


def _direction(places: F64) -> F64:
    _, _, axes = np.linalg.svd(places - places.mean(axis=0), full_matrices=False)
    return np.asarray(axes[0])


def _angle(places: F64) -> float:
    direction = _direction(places)
    return float(np.arctan2(direction[1], direction[0]))


def _angle_std(places: F64) -> float:
    """Return the standard deviation of a line's direction; neighbouring bins share some of their errors."""
    direction = _direction(places)
    offsets = places - places.mean(axis=0)
    across = offsets @ np.array([-direction[1], direction[0]])
    return float(max(across.std(), 3e-4) * np.sqrt(1.5) / np.linalg.norm(offsets @ direction))
