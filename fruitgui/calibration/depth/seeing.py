"""Belt, board and ball found in one averaged picture of an uncorrected device."""

from __future__ import annotations

import cv2
import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.depth.measured import SeenBall, SeenFlat
from fruitgui.calibration.still import INVERSE_STEP, Still
from fruitgui.calibration.surface import fit_belt
from fruitgui.frame import F64, Bools
from fruitgui.geometry.plane import Plane

TILE_PX = (16, 12)
"""Width and height of a tile at 640 pixels across: errors are alike over 9 × 4 (decision 0101)."""

ALIKE_PX = 36.0
"""So many neighbouring pixels of 640 across tell as much as one."""

FULL_TILE = 0.6
FEWEST_TILES = 12
LEAST_RISE_M, LEAST_BOARD_M2 = 0.02, 0.008
MOST_LEAN_RAD = float(np.radians(5.0))
MOST_TURNED_RAD = float(np.radians(15.0))
"""A sensor that was raised may lean so much otherwise."""

CLOSE_SHARE = 0.2
"""What is read so far off what was typed is another thing, or a slip of the pen; no device errs so much."""

LEVEL_M = 0.008
"""A lid is looked for in layers so thick: one that leans by 2° over 40 cm lies in three of them."""

MOST_THINGS = 6
EDGE_PX = 5.0
"""Edges are fattened by up to two pixels and flicker: boards and balls are read this far inside, at 640 across."""

CAP_SHARE = 0.8
"""A ball is read within this share of its radius around its middle: beyond, surfaces are grazed and edges are near."""

LEAST_CAP_PX = 80
BALL_FROM_M = 0.008
ROUND_SHARE = 0.6
"""So much of a ball's cap must carry readings: a piece of a rail is not round."""

SIZE_SHARE = (0.55, 1.7)
"""A ball's picture may have so many times the area that its diameter asks for."""


def see_belt(still: Still) -> SeenFlat | None:
    """Return the belt; None where no plane is in view."""
    belt = fit_belt(still)
    return None if belt is None else _flat(still, belt.on)


def see_board(still: Still, belt: Plane, rise_m: float) -> SeenFlat | None:
    """Return the flat thing above the belt whose height is nearest to one that was typed; None where there is none.

    Args:
        still: uncorrected.
        belt: as read in the picture without the board.
        rise_m: as typed.
    """
    height_m = belt.height_m(still.points())
    above = _inside(still.seen & (height_m > min(LEAST_RISE_M, 0.5 * rise_m)), still)
    count, names, stats, _ = cv2.connectedComponentsWithStats(above.astype(np.uint8), connectivity=4)
    largest = sorted(range(1, count), key=lambda one: -stats[one, cv2.CC_STAT_AREA])[:MOST_THINGS]
    boards = [board for name in largest if (board := _board(still, belt, names == name, height_m)) is not None]
    return min(boards, key=lambda one: abs(read_rise_m(one, belt) - rise_m), default=None)


def read_rise_m(board: SeenFlat, belt: Plane) -> float:
    """Return how far the middle of a board is read to lie above the belt."""
    ray = board.rays.mean(axis=0)
    return float(belt.height_m(ray / (board.coefficients @ ray)))


def see_from_higher(still: Still, belt: SeenFlat, raised_m: float) -> SeenFlat | None:
    """Return the belt as a raised sensor sees it; None where no plane lies as it did.

    From higher the floor may fill more of the picture than the belt: of planes about where the belt must be the largest
    is taken, and where there is none the nearest to it. A sensor that was lowered instead sees most of the belt.

    Args:
        still: uncorrected.
        belt: as read before.
        raised_m: by how much the sensor was raised, as typed.
    """
    normal = planes.plane_of(belt.coefficients).normal
    offs = [
        (abs(read_raised_m(one, belt.coefficients) - raised_m), one)
        for one in planes.candidates(still)
        if planes.plane_of(one).normal @ normal > np.cos(MOST_TURNED_RAD)
    ]
    if not offs:
        return None
    largest = offs[0][1]
    lowered = read_raised_m(largest, belt.coefficients) < -CLOSE_SHARE * raised_m
    close = [one for off_m, one in offs if off_m < CLOSE_SHARE * raised_m]
    nearest = largest if lowered else min(offs, key=lambda one: one[0])[1]
    _, on = planes.refine(still, close[0] if close else nearest, np.ones(still.seen.shape, dtype=bool))
    return _flat(still, on)


def read_raised_m(higher: F64, belt: F64) -> float:
    """Return how much farther from the belt a sensor is read to be than it was, from the a (3,) of both planes."""
    return float(1.0 / np.linalg.norm(higher) - 1.0 / np.linalg.norm(belt))


def read_turn_rad(higher: SeenFlat, belt: SeenFlat) -> float:
    """Return by what angle a sensor is read to lean otherwise than it did."""
    now, then = (planes.plane_of(one.coefficients).normal for one in (higher, belt))
    return float(np.arccos(min(float(now @ then), 1.0)))


def _board(still: Still, belt: Plane, part: Bools, height_m: F64) -> SeenFlat | None:
    """Return the lid of a thing: where most of it has one height; walls hang on to it."""
    z = 1.0 / still.inverse_depth[part]
    if float((z**2).sum()) / (still.intrinsics.fx * still.intrinsics.fy) < LEAST_BOARD_M2:
        return None
    counts, edges = np.histogram(height_m[part], np.arange(0.0, height_m[part].max() + 3 * LEVEL_M, LEVEL_M))
    level_m = edges[int(np.convolve(counts, np.ones(3), "same").argmax())] + LEVEL_M / 2
    level = part & (np.abs(height_m - level_m) < 2 * LEVEL_M)
    if level.sum() < LEAST_CAP_PX:
        return None
    rays, inverse = planes.rays_of(still)[level], still.inverse_depth[level].astype(np.float64)
    first = np.asarray(np.linalg.lstsq(rays, inverse, rcond=None)[0])
    fit, on = planes.refine(still, first, part)
    if on.sum() < 0.8 * level.sum() or fit.plane.normal @ belt.normal < np.cos(MOST_LEAN_RAD):
        return None
    return _flat(still, on)


def see_ball(still: Still, belt: Plane, radius_m: float) -> SeenBall | None:
    """Return the ball of about a radius that lies on the belt; None where there is none.

    Args:
        still: uncorrected.
        belt: as read in the picture without the ball.
        radius_m: as typed.
    """
    height_m = belt.height_m(still.points())
    above = still.seen & (height_m > BALL_FROM_M) & (height_m < 2.6 * radius_m)
    count, names, stats, middles = cv2.connectedComponentsWithStats(above.astype(np.uint8), connectivity=4)
    focal_px = (still.intrinsics.fx * still.intrinsics.fy) ** 0.5
    best: SeenBall | None = None
    for name in range(1, count):
        part = names == name
        nearest_m = float(np.percentile(1.0 / still.inverse_depth[part], 10))
        wanted = np.pi * (radius_m * focal_px / (nearest_m + radius_m)) ** 2
        share = stats[name, cv2.CC_STAT_AREA] / wanted
        if not SIZE_SHARE[0] < share < SIZE_SHARE[1]:
            continue
        u, v = middles[name]
        ball = _ball(still, part, still.intrinsics.rays()[round(v), round(u)], nearest_m, radius_m)
        if ball is not None and (best is None or len(ball.rays) > len(best.rays)):
            best = ball
    return best


def _ball(still: Still, part: Bools, ray: F64, nearest_m: float, radius_m: float) -> SeenBall | None:
    """Fit a sphere of a known radius to one thing; None where it is no such sphere."""
    v, u = np.nonzero(part)
    rays, inverse = planes.rays_of(still)[v, u], still.inverse_depth[v, u].astype(np.float64)
    depth_m = nearest_m + radius_m
    centre = np.array([ray[0] * depth_m, ray[1] * depth_m, depth_m])
    cap: Bools = np.ones(len(rays), dtype=bool)
    spread = 0.0
    for _ in range(6):
        cap = _aside_m(rays, centre) < CAP_SHARE * radius_m
        if cap.sum() < LEAST_CAP_PX:
            return None
        off = inverse[cap] - 1.0 / sphere_depth_m(rays[cap], centre, radius_m)
        spread = 1.4826 * float(np.median(np.abs(off - np.median(off))))
        near = np.abs(off - np.median(off)) < max(3.5 * spread, 2.0 * INVERSE_STEP)
        z_m, by_centre, _ = sphere_slopes(rays[cap][near], centre, radius_m)
        J = -by_centre / z_m[:, None] ** 2
        centre = centre + np.asarray(np.linalg.lstsq(J, off[near], rcond=None)[0])
    used = np.nonzero(cap)[0][near]
    disc_px = np.pi * (CAP_SHARE * radius_m / centre[2]) ** 2 * still.intrinsics.fx * still.intrinsics.fy
    if spread > INVERSE_STEP or len(used) < max(0.8 * cap.sum(), ROUND_SHARE * disc_px):
        return None
    on = np.zeros(part.shape, dtype=bool)
    on[v[used], u[used]] = True
    alike = ALIKE_PX * (still.intrinsics.width / 640) ** 2
    std = max(spread, INVERSE_STEP / 12**0.5) * alike**0.5
    return SeenBall(rays[used], inverse[used], std, centre, radius_m, on)


def sphere_depth_m(rays: F64, centre_m: F64, radius_m: float) -> F64:
    """Return the depth (N,) at which rays (N, 3) meet the near side of a sphere; where they miss, that of its rim."""
    squares = (rays**2).sum(axis=1)
    along = rays @ centre_m
    under = along**2 - squares * (centre_m @ centre_m - radius_m**2)
    return np.asarray((along - np.sqrt(np.maximum(under, 0.0))) / squares)


def sphere_slopes(rays: F64, centre_m: F64, radius_m: float) -> tuple[F64, F64, F64]:
    """Return `sphere_depth_m` and how it changes with centre, (N, 3), and radius, (N,); the rim's not with the radius.

    Where z r is on the sphere, (z r − c)·(z r − c) = R²: as c and R change, r·(z r − c) dz = (z r − c)·dc + R dR.
    """
    z_m = sphere_depth_m(rays, centre_m, radius_m)
    squares, along = (rays**2).sum(axis=1), rays @ centre_m
    outward = z_m[:, None] * rays - centre_m
    facing = z_m * squares - along
    met = facing < 0.0
    by_centre = rays / squares[:, None]
    by_centre[met] = outward[met] / facing[met, None]
    return z_m, by_centre, np.divide(radius_m, facing, out=np.zeros_like(z_m), where=met)


def _aside_m(rays: F64, centre_m: F64) -> F64:
    """Return how far rays (N, 3) pass a point."""
    unit = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    return np.asarray(np.linalg.norm(np.cross(unit, centre_m), axis=1))


def _inside(mask: Bools, still: Still) -> Bools:
    """Return a mask without what lies near its edges."""
    reach = 2 * max(1, round(EDGE_PX * still.intrinsics.width / 640)) + 1
    closed = cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    inner = cv2.erode(closed, np.ones((reach, reach), np.uint8)).astype(bool)
    return np.asarray(inner & mask)


def _flat(still: Still, on: Bools) -> SeenFlat | None:
    """Return means over tiles of what lies on a plane; None where too few tiles are covered."""
    wide, high = (max(2, round(part * still.intrinsics.width / 640)) for part in TILE_PX)
    v, u = np.nonzero(on)
    columns = -(-on.shape[1] // wide)
    tile = (v // high) * columns + u // wide
    tiles = columns * -(-on.shape[0] // high)
    count = np.bincount(tile, minlength=tiles)
    full = count >= FULL_TILE * wide * high
    if full.sum() < FEWEST_TILES:
        return None
    rays, inverse = planes.rays_of(still)[v, u], still.inverse_depth[v, u].astype(np.float64)

    def mean(values: F64) -> F64:
        return np.asarray(np.bincount(tile, values, tiles)[full] / count[full])

    places = np.stack([mean(rays[:, axis]) for axis in range(3)], axis=1)
    means = mean(inverse)
    coefficients = np.asarray(np.linalg.lstsq(places, means, rcond=None)[0])
    grid = np.full(tiles, np.nan)
    grid[full] = means - places @ coefficients
    std = _tile_std(grid.reshape(-1, columns))
    return SeenFlat(places, means, np.full(len(means), std), on, coefficients)


def _tile_std(grid: F64) -> float:
    """Return the standard deviation of a tile by how neighbours differ: what bends slowly does not count."""
    steps = np.concatenate([np.diff(grid, axis=0).ravel(), np.diff(grid, axis=1).ravel()])
    steps = steps[np.isfinite(steps)]
    spread = 1.4826 * float(np.median(np.abs(steps))) / 2**0.5 if len(steps) else 0.0
    return max(spread, 0.05 * INVERSE_STEP)
