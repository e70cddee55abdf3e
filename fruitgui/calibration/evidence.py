"""What speaks for and against a shift: what one sensor sees must not be where the other sees through.

Fitness cannot judge: belt and rails fit as well when turned by 180°. What can is
visibility. A thing that one sensor sees, put where a hypothesis says, must not
stand where the other sensor looks through to something behind it; and where
both see it, colours must agree.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration.flat import Shift
from fruitgui.calibration.relief import Relief
from fruitgui.calibration.still import SAME_READING
from fruitgui.frame import F64, Bools, Ints

UNKNOWN, MET, PIERCED, HIDDEN = 0, 1, 2, 3
FOR_MEETING = 5.0
AGAINST_PIERCING = 12.0
COLOR_STD = 0.05
BACKGROUND_CELL_M = 0.04


class Sight:
    """One relief made ready to be asked what its sensor sees along any ray."""

    def __init__(self, relief: Relief) -> None:
        self.relief = relief
        q = relief.still.inverse_depth
        reach = 2 * max(1, round(2 * relief.still.intrinsics.width / 640)) + 1
        kernel = np.ones((reach, reach), np.uint8)
        self.nearest = cv2.dilate(q, kernel)
        self.farthest = -cv2.dilate(np.where(q > 0, -q, -np.inf).astype(np.float32), kernel)
        share = cv2.boxFilter((q > 0).astype(np.float32), -1, (reach, reach))
        self.sure: Bools = share > 0.7
        total = relief.still.color.astype(np.float64).sum(axis=2, keepdims=True)
        self.chroma = relief.still.color[..., :2] / np.maximum(total, 1.0)
        self.lit: Bools = total[..., 0] > 60

    def judge(self, points_m: F64) -> tuple[Ints, Ints, Ints]:
        """Tell for points (N, 3) in the belt frame what this sensor sees there: verdict, and pixel v and u."""
        still = self.relief.still
        local = self.relief.frame.inverse().apply(points_m)
        ahead = local[:, 2] > 0.2
        pixels = np.zeros((len(local), 2))
        pixels[ahead] = still.intrinsics.project(local[ahead])
        u, v = np.round(np.clip(pixels, -9, 1e5)).astype(int).T
        height, width = still.inverse_depth.shape
        inside = ahead & (u >= 0) & (v >= 0) & (u < width) & (v < height)
        u, v = np.where(inside, u, 0), np.where(inside, v, 0)
        q = 1.0 / np.where(ahead, local[:, 2], 1.0)
        verdict = np.full(len(local), MET)
        verdict[self.farthest[v, u] > q + SAME_READING] = HIDDEN
        verdict[self.nearest[v, u] < q - SAME_READING] = PIERCED
        verdict[~inside | ~self.sure[v, u]] = UNKNOWN
        return verdict, v, u


@dataclass(frozen=True, slots=True, eq=False)
class Testimony:
    """What one sensor's things say about a shift, as the other sensor sees them.

    Attributes:
        met, pierced: (K,) points of each thing that the other sensor sees, or looks through.
        points: (K,) all points of each thing.
        color_gap: (K, 2) difference of chroma where they meet; NaN where unknown.
        pierced_cells: patches of belt, rail and surroundings that the other looks through.
    """

    met: F64
    pierced: F64
    points: F64
    color_gap: F64
    pierced_cells: int

    @property
    def judged(self) -> Bools:
        """(K,) things of which the other sensor sees enough to say anything."""
        seen = self.met + self.pierced
        return np.asarray((seen >= 15) & (seen >= 0.08 * self.points))

    @property
    def share_pierced(self) -> F64:
        """(K,) share of a thing's judged points that the other sensor looks through."""
        return np.asarray(self.pierced / np.maximum(self.met + self.pierced, 1))

    @property
    def conflicting(self) -> Bools:
        """(K,) things that cannot stand where the shift puts them."""
        return self.judged & (self.share_pierced > 0.5)

    @property
    def agreeing(self) -> Bools:
        """(K,) things that stand where the shift puts them."""
        return self.judged & (self.share_pierced < 0.25)


def testimony(source: Sight, target: Sight, shift: Shift) -> Testimony:
    """Ask the target what it sees where the shift puts what the source saw."""
    relief = source.relief
    verdict, v, u = target.judge(shift.apply(relief.points_m))
    count = relief.things
    met: F64 = np.bincount(relief.thing, (verdict == MET).astype(np.float64), count).astype(np.float64)
    pierced: F64 = np.bincount(relief.thing, (verdict == PIERCED).astype(np.float64), count).astype(np.float64)
    return Testimony(
        met=met,
        pierced=pierced,
        points=np.bincount(relief.thing, minlength=count).astype(np.float64),
        color_gap=_color_gap(relief, target, verdict == MET, v, u, count),
        pierced_cells=_pierced_cells(relief.background_m, target.judge(shift.apply(relief.background_m))[0]),
    )


def _color_gap(relief: Relief, target: Sight, met: Bools, v: Ints, u: Ints, count: int) -> F64:
    """Return the mean difference of chroma per thing, (K, 2), over met points; NaN where fewer than 15."""
    mine = relief.colors[:, :2] / np.maximum(relief.colors.sum(axis=1, keepdims=True), 1.0)
    use = met & target.lit[v, u] & (relief.colors.sum(axis=1) > 60)
    gap = mine - target.chroma[v, u]
    n = np.bincount(relief.thing, use, count)
    sums = np.stack([np.bincount(relief.thing, np.where(use, gap[:, k], 0.0), count) for k in range(2)], axis=1)
    return np.where(n[:, None] >= 15, sums / np.maximum(n, 1)[:, None], np.nan)


def _pierced_cells(points_m: F64, verdict: Ints) -> int:
    """Return how many patches of surroundings (of points (N, 3)) are looked through."""
    telling = (verdict == MET) | (verdict == PIERCED)
    if not telling.any():
        return 0
    cells = np.floor(points_m[telling, :2] / BACKGROUND_CELL_M).astype(int)
    _, name = np.unique(cells, axis=0, return_inverse=True)
    total = np.bincount(name.ravel())
    pierced = np.bincount(name.ravel(), verdict[telling] == PIERCED)
    return int(np.count_nonzero((total >= 3) & (pierced > 0.7 * total)))


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """All that speaks for and against a shift.

    Attributes:
        forward, backward: what the source's things say, and the target's.
        log_likelihood: the sum; only differences between shifts of one pair mean anything.
    """

    forward: Testimony
    backward: Testimony
    log_likelihood: float

    @property
    def agreeing(self) -> int:
        """How many things agree, in the view where fewer do."""
        return int(min(self.forward.agreeing.sum(), self.backward.agreeing.sum()))

    @property
    def conflicting(self) -> int:
        """How many things conflict, in the view where more do."""
        return int(max(self.forward.conflicting.sum(), self.backward.conflicting.sum()))


def evidence(source: Sight, target: Sight, shift: Shift, bias_m: F64 | None = None) -> Evidence:
    """Return what speaks for and against a shift; `bias_m` are the residuals per thing of a fit, if there is one."""
    forward = testimony(source, target, shift)
    backward = testimony(target, source, shift.inverse())
    total = _support(forward) + _support(backward) + _colors(forward) + _colors(backward)
    if bias_m is not None:
        total -= float(np.minimum(0.5 * (bias_m / 0.002) ** 2, 12.0).sum())
    return Evidence(forward, backward, total)


def _support(said: Testimony) -> float:
    share = said.share_pierced
    seen = np.minimum((said.met + said.pierced) / np.maximum(0.25 * said.points, 1.0), 1.0)
    things = np.where(said.judged, seen * ((1 - share) * FOR_MEETING - share * AGAINST_PIERCING), 0.0).sum()
    return float(things) - float(min(said.pierced_cells, 40))


def _colors(said: Testimony) -> float:
    """Return the evidence of colour: differences between things, a common cast (white balance) taken off."""
    gap = said.color_gap[said.agreeing & np.isfinite(said.color_gap).all(axis=1)]
    if len(gap) < 2:
        return 0.0
    gap = gap - np.median(gap, axis=0)
    return -float(np.minimum(0.5 * (gap**2).sum(axis=1) / COLOR_STD**2, 10.0).sum())
