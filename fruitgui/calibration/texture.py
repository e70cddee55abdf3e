"""Where the belt's own texture says one sensor stands to another: two colour pictures of one plane, held together.

Fruit hold a shift to about a millimetre only: what stands still in the noise of structured light moves each of them.
Weave, wear and stains of the belt are the same in both colour pictures, once these are laid on the belt's plane, and
there are 10⁵ pixels of them. A texture never finds a shift: it only betters one that things have found, where one
place, and no other near it, makes the pictures alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration.flat import Shift
from fruitgui.calibration.relief import Relief
from fruitgui.frame import F32, F64, Bools, Ints

BROAD_M = 0.012
"""Shades broader than this (standard deviation of a Gaussian) are light and gloss, which move with the eye."""

REACH_M = 0.012
AROUND_M = 0.06
LEAST_CLEAR = 6.0
"""By how many standard deviations of chance meetings the best one must stand out."""

RIVAL = 0.6
TILE_M = 0.08
NARROWEST_M, LEAST_M2 = 0.05, 0.01
CELLS_M = (0.001, 0.004)
MOST_CELLS = 2000
MOST_ROUNDS = 8
WIDEST_TURN_RAD = float(np.radians(0.5))
SMALL = 2e-6
FLOOR_PX = 0.05
FLOOR_RAD = float(np.radians(0.006))
"""What a lens bends unnoticed."""


class Skin:
    """One sensor's colour picture of its belt, made ready to be laid on any plan."""

    def __init__(self, relief: Relief) -> None:
        still = relief.still
        self.relief = relief
        self.grey = still.color.mean(axis=2, dtype=np.float32)
        self.bare = _bare(relief)
        self.belt_m: F64 = relief.background_m[np.abs(relief.background_m[:, 2]) < 0.012, :2]
        depth_m = 1.0 / still.inverse_depth[relief.belt.on]
        self.footprint_m = float(np.median(depth_m)) / still.intrinsics.fx

    def misplaced(self, at_m: F64) -> F64:
        """Return the variances (3,) of x, y (m²) and heading (rad²) that errors of the belt's plane bring at a place.

        Rays meet a plane that is too high or tilted farther out, the more so the flatter they come in.
        """
        eye, spread = self.relief.frame.translation_m, self.relief.belt.covariance
        out = at_m - eye[:2]
        flat = float(out @ out) / eye[2] ** 2
        tilt = float(spread[0, 0] + spread[1, 1])
        place = flat * (spread[2, 2] + float(out @ out) * tilt / 2)
        return np.array([place / 2, place / 2, flat * tilt / 2])

    def laid(self, grid: Grid, shift: Shift) -> Plan:
        """Return the belt's contrast on a grid, of which `shift` leads into this sensor's belt frame."""
        local = self.relief.frame.inverse().apply(shift.apply(grid.places_m().reshape(-1, 3)))
        local[:, 2] = np.maximum(local[:, 2], 1e-3)  # what lies behind falls far outside of the picture
        pixels = self.relief.still.intrinsics.project(local).astype(np.float32).reshape(*grid.shape, 2)
        bright = cv2.remap(self.grey, pixels, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        known = cv2.remap(self.bare, pixels, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT) > 0.99
        return _plan(bright.astype(np.float32), known, grid.cell_m)


def _bare(relief: Relief) -> F32:
    """Return (H, W) 1 where the belt is seen and nothing stands near."""
    margin = 2 * max(2, round(5 * relief.still.intrinsics.width / 640)) + 1
    closed = cv2.morphologyEx(relief.belt.on.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    return np.asarray(cv2.erode(closed, np.ones((margin, margin), np.uint8)), dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """Places on the target's belt: x and y of cell (0, 0), side of a cell, rows and columns."""

    low_m: F64
    cell_m: float
    shape: tuple[int, int]

    def places_m(self) -> F64:
        """Return the cells' middles, (rows, columns, 3)."""
        rows, columns = self.shape
        x, y = (self.low_m[k] + self.cell_m * np.arange(n) for k, n in ((0, columns), (1, rows)))
        return np.stack(np.broadcast_arrays(x, y[:, None], 0.0), axis=-1)


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """One sensor's belt on a grid: contrast (rows, columns), 0 where not known, and 1 where it is known."""

    contrast: F32
    known: F32


@dataclass(frozen=True, slots=True, eq=False)
class Alike:
    """The step that makes two pictures of the belt alike.

    Attributes:
        step: (3,) dx, dy, dθ about `centre_m`, to follow the shift as it was (m, m, rad).
        centre_m: (2,) in the target's belt frame.
        covariance: (3, 3) of the step.
        clear: by how many standard deviations of chance the pictures are alike there.
    """

    step: F64
    centre_m: F64
    covariance: F64
    clear: float


def alike(source: Skin, target: Skin, shift: Shift) -> Alike | None:
    """Return the small step after which the belt looks the same in both pictures; None where that is not clear."""
    grid = _grid(source, target, shift)
    if grid is None:
        return None
    theirs = target.laid(grid, Shift(0.0, 0.0, 0.0))
    mine = source.laid(grid, shift.inverse())
    if _too_small(theirs.known * mine.known, grid):
        return None
    found = _best_meeting(mine, theirs, grid.cell_m)
    if found is None:
        return None
    start, clear = found
    refined = _refined(mine, theirs, grid, start)
    if refined is None:
        return None
    step, covariance = refined
    centre = _centre_m(theirs, grid)
    place = (FLOOR_PX * grid.cell_m) ** 2
    floor = np.array([place, place, FLOOR_RAD**2])
    floor += target.misplaced(centre) + source.misplaced(shift.inverse().apply(centre))
    return Alike(step, centre, covariance + np.diag(floor), clear)


def _grid(source: Skin, target: Skin, shift: Shift) -> Grid | None:
    """Return a grid over the belt that both see, as fine as the coarser picture."""
    if min(len(source.belt_m), len(target.belt_m)) < 50:
        return None
    a, b = shift.apply(source.belt_m), target.belt_m
    low, high = np.maximum(a.min(axis=0), b.min(axis=0)), np.minimum(a.max(axis=0), b.max(axis=0))
    if (high - low < NARROWEST_M).any():
        return None
    cell_m = float(np.clip(max(source.footprint_m, target.footprint_m), *CELLS_M))
    columns, rows = np.minimum(np.ceil((high - low) / cell_m).astype(int), MOST_CELLS)
    return Grid(low, cell_m, (int(rows), int(columns)))


def _too_small(both: F32, grid: Grid) -> bool:
    return float(both.sum()) * grid.cell_m**2 < LEAST_M2


def _plan(bright: F32, known: Bools, cell_m: float) -> Plan:
    """Return brightness against that of the surroundings, the same whatever light and exposure."""
    mask = known.astype(np.float32)
    broad = BROAD_M / cell_m
    near = cv2.GaussianBlur(mask, (0, 0), broad)
    mean = cv2.GaussianBlur(bright * mask, (0, 0), broad) / np.maximum(near, np.float32(1e-3))
    contrast = np.where(known & (mean > 2.0), bright / np.maximum(mean, np.float32(1.0)) - 1, 0).astype(np.float32)
    if known.any():
        bound = 4 * 1.4826 * float(np.median(np.abs(contrast[known])))
        contrast = np.clip(contrast, -bound, bound)
    return Plan(cv2.GaussianBlur(contrast, (0, 0), 1.0).astype(np.float32), mask)


def _best_meeting(mine: Plan, theirs: Plan, cell_m: float) -> tuple[F64, float] | None:
    """Return the move (2,) of `mine` under which both are most alike, and how clear that is; None where it is not."""
    lags = round(AROUND_M / cell_m)
    score = _correlation(mine, theirs, lags)
    y, x = np.mgrid[-lags : lags + 1, -lags : lags + 1] * cell_m
    far = np.hypot(x, y)
    best = int(np.argmax(np.where(far <= REACH_M, score, -np.inf)))
    top = float(score.flat[best])
    chance = float(score[far > 2 * REACH_M].std())
    if chance <= 0 or top < LEAST_CLEAR * chance or far.flat[best] > REACH_M - cell_m:
        return None
    _, names = cv2.connectedComponents((score > RIVAL * top).astype(np.uint8), connectivity=8)
    alone = not ((names > 0) & (names != names.flat[best])).any()
    return (np.array([x.flat[best], y.flat[best]]), top / chance) if alone else None


def _correlation(mine: Plan, theirs: Plan, lags: int) -> F64:
    """Return how alike two plans are for moves of `mine` by −lags…lags cells in y and x."""
    from scipy import fft

    shape = tuple(fft.next_fast_len(n + lags, real=True) for n in mine.contrast.shape)
    spectra = [fft.rfft2(layer, shape) for layer in (theirs.contrast, mine.contrast, theirs.known, mine.known)]
    score = fft.irfft2(spectra[0] * np.conj(spectra[1]), shape)
    both = fft.irfft2(spectra[2] * np.conj(spectra[3]), shape)
    index = np.arange(-lags, lags + 1)
    window = np.ix_(index % shape[0], index % shape[1])
    return np.asarray(score[window] / np.sqrt(np.maximum(both[window], 100.0)), dtype=np.float64)


def _centre_m(theirs: Plan, grid: Grid) -> F64:
    v, u = np.nonzero(theirs.known)
    return np.asarray(grid.low_m + grid.cell_m * np.array([u.mean(), v.mean()]))


def _refined(mine: Plan, theirs: Plan, grid: Grid, start: F64) -> tuple[F64, F64] | None:
    """Return the step at which both are most alike (Newton), from a move (2,), and its covariance.

    None where it leaves what was searched: then nothing holds it.
    """
    centre = _centre_m(theirs, grid)
    step = np.array([*start, 0.0])
    rim = np.ones((7, 7), np.uint8)  # there, what is not known is blurred into the contrast
    for _ in range(MOST_ROUNDS):
        moved = _moved(mine, grid, centre, step)
        both = cv2.erode(((moved.known > 0.99) & (theirs.known > 0)).astype(np.uint8), rim) > 0
        if _too_small(both.astype(np.float32), grid):
            return None
        pulls, H = _pulls(moved, theirs, both, grid, centre)
        change = -np.linalg.solve(H + 1e-6 * np.diag(np.abs(np.diag(H))), pulls.sum(axis=0))
        step = step + change
        if np.hypot(*step[:2]) > REACH_M or abs(step[2]) > WIDEST_TURN_RAD:
            return None
        if np.abs(change).max() < SMALL:
            break
    v, u = np.nonzero(both)
    return step, _covariance(pulls, H, grid.cell_m * np.stack([u, v], axis=1).astype(np.float64))


def _moved(plan: Plan, grid: Grid, centre_m: F64, step: F64) -> Plan:
    """Return a plan moved by a step on its own grid."""
    back = Shift(0.0, 0.0, 0.0).about(centre_m, step).inverse()
    R = back.rotation
    offset = (R @ grid.low_m + back.move_m - grid.low_m) / grid.cell_m
    matrix = np.hstack([R, offset[:, None]])
    size = grid.shape[::-1]
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return Plan(*(cv2.warpAffine(layer, matrix, size, flags=flags) for layer in (plan.contrast, plan.known)))


def _pulls(mine: Plan, theirs: Plan, both: Bools, grid: Grid, centre_m: F64) -> tuple[F64, F64]:
    """Return each cell's pull (N, 3) on a step that moves mine, and how pulls grow with the step (3, 3).

    What is made least is minus the product of both pictures. Its slopes hold products across pictures only, so that
    the noise of one never passes for texture, as it would in squares of differences.
    """
    a, b = (plan.contrast / plan.contrast[both].std() for plan in (mine, theirs))
    v, u = np.nonzero(both)
    slope_a, slope_b = (_slopes(layer, u, v, grid, centre_m) for layer in (a, b))
    pulls = (slope_b * a[v, u][:, None] - slope_a * b[v, u][:, None]) / 2
    H = slope_a.T @ slope_b
    return pulls, (H + H.T) / 2


def _slopes(layer: F32, u: Ints, v: Ints, grid: Grid, centre_m: F64) -> F64:
    """Return how a layer changes at cells when it makes a step, (N, 3)."""
    gx = cv2.Sobel(layer, cv2.CV_64F, 1, 0, ksize=1, scale=0.5 / grid.cell_m)[v, u]
    gy = cv2.Sobel(layer, cv2.CV_64F, 0, 1, ksize=1, scale=0.5 / grid.cell_m)[v, u]
    x, y = (grid.low_m[k] + grid.cell_m * at - centre_m[k] for k, at in enumerate((u, v)))
    return -np.stack([gx, gy, gy * x - gx * y], axis=1)


def _covariance(pulls: F64, H: F64, places_m: F64) -> F64:
    """Return the (3, 3) covariance with whole tiles as independent witnesses."""
    _, tile = np.unique(np.floor(places_m / TILE_M) @ [1, 10_000], return_inverse=True)
    count = int(tile.max()) + 1
    sums = np.stack([np.bincount(tile, pulls[:, k], count) for k in range(3)], axis=1)
    inverse = np.linalg.pinv(H)
    return np.asarray(inverse @ (sums.T @ sums) @ inverse * count / max(count - 3, 1))
