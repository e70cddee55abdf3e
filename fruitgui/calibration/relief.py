"""What one sensor saw above its belt, laid flat: points, normals, colours and things, in the belt's own frame.

In that frame (`plane.frame()`: z up from the belt, z = 0 on it) two sensors over one belt
differ only by a shift and a heading.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.still import INVERSE_NOISE, INVERSE_STEP, Still
from fruitgui.calibration.surface import Belt
from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.pose import Pose

CELL_M = 0.006
LOWEST_M = 0.012
HIGHEST_M = 0.35
LARGEST_THING_M = 0.45
LOW_RAIL_M = 0.03
RAIL_GAP_M = 0.07
POINTS_PER_THING = 800

UNSEEN, EMPTY, RISEN = 0, 1, 2


@dataclass(frozen=True, slots=True, eq=False)
class Ground:
    """The belt's plan as one sensor saw it.

    Attributes:
        state: (rows, columns) UNSEEN, EMPTY (belt seen) or RISEN (something stands there).
        height_m: (rows, columns) highest reading, 0 where none.
        low_m: (2,) x and y of the corner of cell (0, 0).
        cell_m: side of a cell.
    """

    state: Ints
    height_m: F64
    low_m: F64
    cell_m: float

    def at(self, xy_m: F64) -> Ints:
        """Return the state at points (…, 2); UNSEEN outside."""
        index = np.floor((xy_m - self.low_m) / self.cell_m).astype(int)
        rows, columns = self.state.shape
        inside = (index >= 0).all(axis=-1) & (index[..., 0] < columns) & (index[..., 1] < rows)
        index = np.where(inside[..., None], index, 0)
        return np.where(inside, self.state[index[..., 1], index[..., 0]], UNSEEN)


@dataclass(frozen=True, slots=True, eq=False)
class Relief:
    """One sensor's view of the still scene in its belt's frame.

    Attributes:
        still: the averaged picture.
        belt: its surface.
        frame: optical frame → belt's frame.
        points_m, normals: (N, 3) surface of things, away from depth edges; normals point out.
        colors: (N, 3) RGB.
        thing: (N,) which thing each point belongs to.
        peaks_m: (P, 3) tops of things: x, y, height.
        background_m: (M, 3) belt, rails and whatever else stands still, away from depth edges.
        ground: plan of what is empty and what is not.
        edge_px: how far from depth edges readings are believed.
    """

    still: Still
    belt: Belt
    frame: Pose
    points_m: F64
    normals: F64
    colors: F64
    thing: Ints
    peaks_m: F64
    background_m: F64
    ground: Ground

    @property
    def sensor(self) -> str:
        """The sensor's id."""
        return self.still.sensor

    @property
    def distance_m(self) -> float:
        """How far the sensor stands from what it sees of things, at the median."""
        local = self.frame.inverse().apply(self.points_m) if len(self.points_m) else np.ones((1, 3))
        return float(np.median(local[:, 2]))

    @property
    def things(self) -> int:
        """How many separate things stand on the belt."""
        return int(self.thing.max()) + 1 if len(self.thing) else 0


def edge_px(still: Still) -> float:
    """Return how far from a depth edge a reading must be to be believed: fattening grows with resolution."""
    return max(1.0, 1.0 * still.intrinsics.width / 640)


def relief(still: Still, belt: Belt) -> Relief:
    """Lay one sensor's averaged picture on its belt."""
    frame = belt.plane.frame()
    flat = frame.apply(still.points())
    height_m = flat[..., 2]
    sound = still.seen & (far_from_edges(still) >= edge_px(still))
    z = np.divide(1.0, still.inverse_depth, out=np.zeros_like(still.inverse_depth), where=still.seen)
    noise_m = (0.5 * INVERSE_STEP + 3.0 * INVERSE_NOISE / np.sqrt(min(still.captures, 8))) * z**2
    risen = still.seen & (height_m > LOWEST_M + noise_m) & (height_m < HIGHEST_M)
    ground = _ground(flat, still.seen, risen & sound, np.abs(height_m) < 0.006 + noise_m)
    names = _things(ground, belt, frame)
    thing_of_pixel = np.where(risen & sound, _lookup(ground, names, flat), 0)
    pixels = _chosen_pixels(thing_of_pixel)
    thing = np.unique(thing_of_pixel[pixels], return_inverse=True)[1].astype(np.intp)
    normals, smooth = _normals(still, risen & sound, pixels)
    order = np.nonzero(smooth)[0]
    v, u = pixels[0][order], pixels[1][order]
    return Relief(
        still=still,
        belt=belt,
        frame=frame,
        points_m=flat[v, u],
        normals=frame.turn(normals[order]),
        colors=still.color[v, u].astype(np.float64),
        thing=thing[order],
        peaks_m=_peaks(ground, names),
        background_m=_background(flat, sound & (np.abs(height_m) < HIGHEST_M) & (thing_of_pixel == 0)),
        ground=ground,
    )


def far_from_edges(still: Still) -> F64:
    """Return each pixel's distance, in pixels, from the nearest jump of depth or missing reading."""
    inverse = still.inverse_depth
    jump = 3.2 * INVERSE_STEP
    edge = ~still.seen
    for axis in (0, 1):
        steps = np.abs(np.diff(inverse, axis=axis)) > jump
        before = [slice(None), slice(None)]
        after = [slice(None), slice(None)]
        before[axis], after[axis] = slice(None, -1), slice(1, None)
        edge[tuple(before)] |= steps
        edge[tuple(after)] |= steps
    edge[0], edge[-1], edge[:, 0], edge[:, -1] = True, True, True, True
    return np.asarray(cv2.distanceTransform((~edge).astype(np.uint8), cv2.DIST_L2, 3), dtype=np.float64)


def _ground(flat: F64, seen: Bools, risen: Bools, low: Bools) -> Ground:
    near = seen & (np.abs(flat[..., :2]).max(axis=2) < 3.0)
    if not near.any():
        return Ground(np.zeros((1, 1), np.intp), np.zeros((1, 1)), np.zeros(2), CELL_M)
    low_m = flat[near][:, :2].min(axis=0)
    size = np.floor((flat[near][:, :2].max(axis=0) - low_m) / CELL_M).astype(int) + 1
    index = np.floor((flat[..., :2] - low_m) / CELL_M).astype(int)
    empty = np.zeros((size[1], size[0]), np.uint8)
    empty[tuple(index[near & low].T[::-1])] = 1
    empty = cv2.morphologyEx(empty, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    height_m = np.zeros((size[1], size[0]))
    cells = index[near & risen]
    np.maximum.at(height_m, (cells[:, 1], cells[:, 0]), flat[near & risen][:, 2])
    state = np.where(height_m > 0, RISEN, empty.astype(np.intp)).astype(np.intp)
    return Ground(state, height_m, low_m, CELL_M)


def _things(ground: Ground, belt: Belt, frame: Pose) -> Ints:
    """Name the connected patches that stand on the belt, 1…K; 0 elsewhere and on what is too long to be a thing.

    What lies mostly outside the region, and what runs on like a rail or a wall, is background.
    """
    risen = cv2.dilate((ground.state == RISEN).astype(np.uint8), np.ones((3, 3), np.uint8))
    count, names, stats, _ = cv2.connectedComponentsWithStats(risen, connectivity=8)
    names = np.where(ground.state == RISEN, names, 0)
    inside = _inside_region(ground, belt, frame)
    cells = np.bincount(names.ravel(), minlength=count)
    kept = np.bincount(names[inside], minlength=count) > 0.6 * cells
    length_m = np.hypot(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]) * ground.cell_m
    kept &= np.bincount(names[_low_rails(ground)], minlength=count) < 0.6 * cells
    good = kept & (length_m < LARGEST_THING_M) & (cells * ground.cell_m**2 > 2.5e-4)
    good[0] = False
    renamed = np.where(good, np.cumsum(good), 0)
    return np.asarray(renamed[names], dtype=np.intp)


def _low_rails(ground: Ground) -> Bools:
    """Return cells of what is low and, gaps closed, long: a rail barely above the noise, seen in pieces."""
    low = ((ground.state == RISEN) & (ground.height_m < LOW_RAIL_M)).astype(np.uint8)
    reach = 2 * round(RAIL_GAP_M / ground.cell_m / 2) + 1
    closed = cv2.morphologyEx(low, cv2.MORPH_CLOSE, np.ones((reach, reach), np.uint8))
    _, names, stats, _ = cv2.connectedComponentsWithStats(closed, connectivity=8)
    length_m = np.hypot(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]) * ground.cell_m
    long = length_m > LARGEST_THING_M
    long[0] = False
    return np.asarray(long[names] & (low > 0))


def _inside_region(ground: Ground, belt: Belt, frame: Pose) -> Bools:
    if belt.surface.region_m is None:
        return np.ones(ground.state.shape, dtype=bool)
    corners = (frame.apply(belt.surface.region_m)[:, :2] - ground.low_m) / ground.cell_m - 0.5
    mask = np.zeros(ground.state.shape, np.uint8)
    cv2.fillPoly(mask, [np.round(corners).astype(np.int32)], 1)
    return mask.astype(bool)


def _lookup(ground: Ground, names: Ints, flat: F64) -> Ints:
    index = np.floor((flat[..., :2] - ground.low_m) / ground.cell_m).astype(int)
    rows, columns = names.shape
    inside = (index >= 0).all(axis=2) & (index[..., 0] < columns) & (index[..., 1] < rows)
    index = np.where(inside[..., None], index, 0)
    return np.where(inside, names[index[..., 1], index[..., 0]], 0)


def _chosen_pixels(thing_of_pixel: Ints) -> tuple[Ints, Ints]:
    """Return at most POINTS_PER_THING pixels of each thing, evenly thinned."""
    v, u = np.nonzero(thing_of_pixel)
    names = thing_of_pixel[v, u]
    order = np.argsort(names, kind="stable")
    counts = np.bincount(names)
    starts = np.cumsum(counts) - counts
    place = np.arange(len(order)) - starts[names[order]]
    step = np.maximum(counts / POINTS_PER_THING, 1.0)[names[order]]
    chosen = order[np.floor(place / step) != np.floor((place - 1) / step)]
    return v[chosen], u[chosen]


def _normals(still: Still, usable: Bools, pixels: tuple[Ints, Ints]) -> tuple[F64, Bools]:
    """Return outward normals (N, 3) in the optical frame, and which come from enough pixels.

    A plane 1/z = a·(x, y, 1) is fitted to the usable pixels of a window about each pixel.
    """
    window = 2 * max(2, round(4 * still.intrinsics.width / 640)) + 1
    rays = planes.rays_of(still)
    x, y = rays[..., 0], rays[..., 1]
    q = still.inverse_depth.astype(np.float64)
    use = usable.astype(np.float64)
    terms = [use * x * x, use * x * y, use * x, use * y * y, use * y, use, use * x * q, use * y * q, use * q]
    xx, xy, sx, yy, sy, n, xq, yq, sq = (
        cv2.boxFilter(term, cv2.CV_64F, (window, window), normalize=False)[pixels] for term in terms
    )
    A = np.stack([np.stack([xx, xy, sx], -1), np.stack([xy, yy, sy], -1), np.stack([sx, sy, n], -1)], -2)
    smooth = (n > 0.3 * window**2) & (np.linalg.det(A) > 1e-9 * np.maximum(n, 1) ** 3 * (window / 600) ** 4)
    A[~smooth] = np.eye(3)
    a = np.linalg.solve(A, np.stack([xq, yq, sq], -1)[..., None])[..., 0]
    length = np.linalg.norm(a, axis=1, keepdims=True)
    return -a / np.maximum(length, 1e-12), smooth & (length[:, 0] > 0)


def _peaks(ground: Ground, names: Ints) -> F64:
    """Return the tops of things (P, 3): the centres of what reaches the upper quarter about each local maximum."""
    height_m = np.where(names > 0, ground.height_m, 0.0).astype(np.float32)
    weight = (height_m > 0).astype(np.float32)
    blur = 2 * round(0.012 / ground.cell_m) + 1
    smooth = cv2.GaussianBlur(height_m, (blur, blur), 0) / np.maximum(cv2.GaussianBlur(weight, (blur, blur), 0), 1e-6)
    smooth = np.where(weight > 0, smooth, 0.0)
    reach = round(0.022 / ground.cell_m)
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))
    tops = (smooth > 0) & (smooth >= cv2.dilate(smooth.astype(np.float32), disc) - 1e-6)
    found = [_top(smooth, int(v), int(u), reach) for v, u in zip(*np.nonzero(tops), strict=True)]
    if not found:
        return np.zeros((0, 3))
    peaks = np.array(found)
    peaks[:, :2] = (peaks[:, :2] + 0.5) * ground.cell_m + ground.low_m
    return _thinned(peaks)


def _top(smooth: F64, v: int, u: int, reach: int) -> tuple[float, float, float]:
    v0, u0 = max(v - reach, 0), max(u - reach, 0)
    patch = smooth[v0 : v + reach + 1, u0 : u + reach + 1]
    top = float(smooth[v, u])
    weight = np.clip(patch - 0.75 * top, 0.0, None)
    total = float(weight.sum())
    rows, columns = np.mgrid[v0 : v0 + patch.shape[0], u0 : u0 + patch.shape[1]]
    return float((weight * columns).sum() / total), float((weight * rows).sum() / total), top


def _thinned(peaks: F64, apart_m: float = 0.025) -> F64:
    """Keep the higher of any two peaks that are closer than `apart_m`."""
    order = np.argsort(-peaks[:, 2])
    kept: list[int] = []
    for i in order:
        if all(np.hypot(*(peaks[i, :2] - peaks[j, :2])) > apart_m for j in kept):
            kept.append(int(i))
    return np.asarray(peaks[kept])


def _background(flat: F64, usable: Bools) -> F64:
    grid = np.zeros_like(usable)
    grid[::6, ::6] = True
    return np.asarray(flat[usable & grid])
