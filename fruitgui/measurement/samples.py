"""Which points and which places of an outline speak for a fruit: those that are surely its own."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from fruitgui.frame import F32, F64, Bools, Intrinsics, Ints
from fruitgui.perception.view import FruitView

EDGE_PX = 3.0
"""Points nearer to the edge of their picture than this lie: structured light fattens edges by up to two pixels."""

CUT_PX = 6.0
"""Points nearer than this to where touching fruit were cut apart may be the neighbour's: half of the matching window
(9 px), and what the cut itself may be off."""

CLEAR_PLACES = 4
"""An outline is not trusted so far from where a neighbour begins either: fattened edges fill the crease."""

LEAST_POINTS = 8


def take_samples(
    views: Sequence[FruitView], sensor: Ints, cameras: Sequence[Intrinsics], count: int, rim: int
) -> tuple[F64, Bools]:
    """Return (V, count + rim, 3) samples in their sensors' optical frames, and which are used.

    `count` points away from the edge of each view, then `rim` on the sights
    along its outline, as far as that is the fruit's own. `sensor` (V,) tells the cameras.
    """
    samples = np.empty((len(views), count + rim, 3))
    used = np.zeros(samples.shape[:2], dtype=bool)
    outline = np.zeros((len(views), rim, 2), dtype=np.float32)
    for view, camera, sample, use, around in zip(views, sensor.tolist(), samples, used, outline, strict=True):
        free = own_places(view)
        index = _inner(view, count, free, cameras[camera])
        sample[: len(index)] = view.points_m[index]
        sample[len(index) :] = view.centre_m
        use[: len(index)] = True
        if len(free) >= 2 * rim:
            chosen = evenly(len(free), rim)
            around[:] = view.outline_px[chosen]
            use[count:] = free[chosen]
    for number, camera in enumerate(cameras):
        mine = sensor == number
        samples[mine, count:, :2] = sights(outline[mine], camera) * samples[mine, count:, 2:]
    return samples, used


def own_places(view: FruitView) -> Bools:
    """Return which places (K,) of a view's outline are the fruit's own, well away from where another one begins."""
    free = view.outline_free
    return np.asarray(free if free.all() else free & np.roll(free, CLEAR_PLACES) & np.roll(free, -CLEAR_PLACES))


def sights(places_px: F32, camera: Intrinsics) -> F64:
    """Return x/z and y/z (…, 2) of the sights through places (…, 2) of a picture."""
    u, v = np.rint(places_px.reshape(-1, 2)).astype(np.intp).T
    u, v = np.minimum(np.maximum(u, 0), camera.width - 1), np.minimum(np.maximum(v, 0), camera.height - 1)
    return np.asarray(camera.rays()[v, u].reshape(places_px.shape))


@lru_cache(maxsize=4096)
def evenly(length: int, count: int) -> Ints:
    """Return `count` indices spread evenly over so many. Shared; do not write."""
    index = ((np.arange(count) + 0.5) * (length / count)).astype(np.intp)
    index.setflags(write=False)
    return index


def _inner(view: FruitView, count: int, free: Bools, camera: Intrinsics) -> Ints:
    """Return the indices of at most `count` points of a view, away from its edge as far as its size allows."""
    inner = (view.edge_px >= min(EDGE_PX, 0.45 * float(view.edge_px.max()))).nonzero()[0]
    index = inner if len(inner) >= LEAST_POINTS else np.arange(len(view.points_m))
    if not free.all():
        index = _at_most(index, 2 * count)
        clear = index[_clear_of_cuts(view, index, free, camera)]
        index = clear if len(clear) >= LEAST_POINTS else index
    return _at_most(index, count)


def _at_most(index: Ints, count: int) -> Ints:
    return index if len(index) <= count else index.take(evenly(len(index), count))


def _clear_of_cuts(view: FruitView, index: Ints, free: Bools, camera: Intrinsics) -> Bools:
    """Tell which points of a view lie clear of where the outline is not the fruit's own."""
    points = view.points_m[index]
    apart = (points[:, :2] / points[:, 2:])[:, None] - sights(view.outline_px[~free][::3], camera)
    return np.asarray((apart * apart).sum(axis=2).min(axis=1) > (CUT_PX / camera.fx) ** 2)
