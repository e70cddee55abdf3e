from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.measurement.samples import CUT_PX, own_places, take_samples
from fruitgui.measurement.size import measure
from fruitgui.perception.view import FruitView
from fruitgui.tracking.track import Sighting, Track
from tests.unit.measurement.solids import CAMERA, Solid, track_of

SOLID = Solid((0.045, 0.034, 0.033), (0.0, 0.0, 0.3))


def touched(view: FruitView, before_m: float, beyond_m: float) -> FruitView:
    """Return the view as it is when a neighbour touches the fruit on the side that the belt runs to.

    Its end is cut off `before_m` from the middle, and a plate of the neighbour's, `beyond_m` wide, counts as its own.
    """
    side = 1.0 if view.sensor == "kinect_1" else -1.0
    cut_u = float(CAMERA.project(view.centre_m[None])[0, 0] + side * before_m * CAMERA.fx / view.centre_m[2])
    kept = side * (view.points_m[:, 0] / view.points_m[:, 2] * CAMERA.fx + CAMERA.cx - cut_u) < 0.0
    outline, free = view.outline_px.copy(), side * (view.outline_px[:, 0] - cut_u) < -1.0
    outline[~free, 0] = cut_u
    rows = np.arange(view.outline_px[:, 1].min() + 4, view.outline_px[:, 1].max() - 4)
    width = round(beyond_m * CAMERA.fx / float(view.centre_m[2]))
    u, v = np.meshgrid(cut_u + side * np.arange(width), rows)
    depth = np.full(u.shape, view.points_m[:, 2].min())
    strange = np.stack([(u - CAMERA.cx) / CAMERA.fx * depth, (v - CAMERA.cy) / CAMERA.fy * depth, depth], axis=-1)
    points = np.concatenate([view.points_m[kept], strange.reshape(-1, 3)]).astype(np.float32)
    edge = np.concatenate([view.edge_px[kept], np.full(strange[..., 0].size, 4.0, np.float32)])
    return replace(view, points_m=points, edge_px=edge, outline_px=outline, outline_free=free, shared=True)


def with_views(track: Track, views: list[FruitView]) -> Track:
    return replace(track, sightings=tuple(Sighting(view.time_s, view) for view in views))


def test_cut_places_and_points_beside_them_are_not_used() -> None:
    view = touched(track_of(SOLID)[0].sightings[20].view, 0.02, 0.003)
    samples, used = take_samples([view], np.zeros(1, np.intp), [CAMERA], 60, 20)
    cut_px = view.outline_px[~view.outline_free]
    assert 0 < used[0, 60:].sum() < 20
    for chosen, least_px in ((samples[0, :60][used[0, :60]], CUT_PX), (samples[0, 60:][used[0, 60:]], 1.0)):
        apart = np.linalg.norm(CAMERA.project(chosen)[:, None] - cut_px[None], axis=2)
        # every third place of the cut is asked, and a pixel is a pixel
        assert apart.min() > least_px - 1.0


def test_an_outline_is_not_trusted_where_a_neighbour_begins() -> None:
    view = touched(track_of(SOLID)[0].sightings[3].view, 0.02, 0.003)
    assert own_places(view).sum() < view.outline_free.sum()
    assert not (own_places(view) & ~view.outline_free).any()
    assert own_places(replace(view, outline_free=np.ones(len(view.outline_px), bool))).all()


@pytest.mark.parametrize(("share", "within"), [(0.5, 0.05), (1.0, 0.12)])
def test_a_fruit_that_touches_another_is_measured_by_what_is_its_own(share: float, within: float) -> None:
    track, rig = track_of(SOLID, 3)
    views = [sighting.view for sighting in track.sightings]
    spoilt = [touched(view, 0.025, 0.003) if k >= (1.0 - share) * len(views) else view for k, view in enumerate(views)]
    size = measure(with_views(track, spoilt), rig)
    assert abs(size.volume_m3.value - SOLID.volume_m3) < 2.6 * size.volume_m3.std
    assert size.volume_m3.value == pytest.approx(SOLID.volume_m3, rel=within)
    assert abs(size.length_m.value - SOLID.length_m) < 2.6 * size.length_m.std
    # an end that nobody ever saw, a fifth of the length, makes it less sure
    assert share < 1.0 or size.volume_m3.std > 1.3 * measure(track, rig).volume_m3.std
