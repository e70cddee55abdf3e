"""Depth of a camera of its own, brought into the colour picture, against rays cast from the colour camera itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.sensors.lens import pixels_of_rays
from fruitgui.sensors.registration import Registration

KINECT_DEPTH = Intrinsics(320, 240, 290.0, 290.5, 157.0, 121.5, (-0.12, 0.21, 0.001, -0.0015, -0.1))
KINECT_COLOR = Intrinsics(320, 240, 262.5, 262.0, 159.5, 119.5, (0.18, -0.4, -0.001, 0.002, 0.3))
BESIDE = Pose(rotation_from_vector(np.array([0.004, -0.006, 0.003])), np.array([-0.025, 0.0006, -0.001]))


@dataclass(frozen=True)
class Scene:
    """A tilted wall and a card before it, in the depth camera's frame: points p with normal·p = offset."""

    wall: F64
    wall_m: float
    card_m: float = 0.0
    card_half_m: float = 0.12

    def depth_m(self, camera: Intrinsics, to_scene: Pose) -> tuple[F64, F64]:
        """Return (z along the camera's axis, whether the card is seen), (height, width) each."""
        rays = camera.rays().astype(np.float64)
        directions = to_scene.turn(np.concatenate([rays, np.ones((*rays.shape[:2], 1))], axis=-1))
        origin = to_scene.translation_m
        z = (self.wall_m - origin @ self.wall) / (directions @ self.wall)
        card = np.zeros(z.shape, dtype=bool)
        if self.card_m:
            z_card = (self.card_m - origin[2]) / directions[..., 2]
            hit = origin + directions * z_card[..., None]
            card = (np.abs(hit[..., 0]) < self.card_half_m) & (np.abs(hit[..., 1]) < self.card_half_m) & (z_card < z)
            z = np.where(card, z_card, z)
        return z, card


WALL = Scene(np.array([0.25, -0.35, 0.9]), 1.0)
CARD = Scene(np.array([0.0, 0.0, 1.0]), 1.4, card_m=0.9)


def registered(scene: Scene, depth: Intrinsics, color: Intrinsics, pose: Pose) -> tuple[F64, F64, F64]:
    """Return (registered metres, true metres, card seen) in the colour picture."""
    seen_m, _ = scene.depth_m(depth, Pose())
    mm = np.rint(seen_m * 1000.0).astype(np.uint16)
    true_m, card = scene.depth_m(color, pose.inverse())
    return Registration(depth, color, pose).apply(mm) / 1000.0, true_m, card


def inside(shape: tuple[int, int], margin: float) -> np.ndarray:
    """A mask of the middle of a picture, which both cameras see."""
    mask = np.zeros(shape, dtype=bool)
    v, u = int(shape[0] * margin), int(shape[1] * margin)
    mask[v:-v, u:-u] = True
    return mask


def slope_m(true_m: F64) -> float:
    """The most that depth changes from one pixel to the next."""
    return float(max(np.abs(np.diff(true_m, axis=0)).max(), np.abs(np.diff(true_m, axis=1)).max()))


def scaled(camera: Intrinsics, factor: float) -> Intrinsics:
    return Intrinsics(
        round(camera.width * factor), round(camera.height * factor), camera.fx * factor, camera.fy * factor,
        (camera.cx + 0.5) * factor - 0.5, (camera.cy + 0.5) * factor - 0.5, camera.distortion,
    )  # fmt: skip


@pytest.mark.parametrize(("depth_scale", "color_scale"), [(1, 1), (1, 2), (0.5, 1), (1, 0.5), (0.5, 2), (1, 1.5)])
def test_wall_lies_where_the_colour_camera_sees_it(depth_scale: float, color_scale: float) -> None:
    """Off by no more than half a pixel of either camera's slope and the rounding to millimetres."""
    depth, color = scaled(KINECT_DEPTH, depth_scale), scaled(KINECT_COLOR, color_scale)
    got_m, true_m, _ = registered(WALL, depth, color, BESIDE)
    middle = inside(got_m.shape, 0.14)
    assert (got_m[middle] > 0).mean() > 0.999
    there = middle & (got_m > 0)
    step_px = color.fx / depth.fx
    bound_m = slope_m(true_m) * (1.0 + max(step_px, 1.0)) + 1.1e-3
    error_m = (got_m - true_m)[there]
    assert np.abs(error_m).max() < bound_m
    assert abs(error_m.mean()) < 0.2e-3 + 0.1 * slope_m(true_m)


@pytest.mark.parametrize("color_scale", [1, 2])
def test_nearest_surface_wins_and_edges_lie_on_colour_edges(color_scale: float) -> None:
    color = scaled(KINECT_COLOR, color_scale)
    got_m, true_m, card = registered(CARD, KINECT_DEPTH, color, BESIDE)
    near = (got_m > 0) & (got_m < 1.1)
    rows, columns = np.nonzero(card)
    seen = near & inside(got_m.shape, 0.05)
    got_rows, got_columns = np.nonzero(seen)
    reach_px = 1.0 + color_scale
    assert abs(got_rows.min() - rows.min()) <= reach_px
    assert abs(got_rows.max() - rows.max()) <= reach_px
    assert abs(got_columns.min() - columns.min()) <= reach_px
    assert abs(got_columns.max() - columns.max()) <= reach_px
    border = round(reach_px) + 1
    core = np.zeros_like(card)
    core[rows.min() + border : rows.max() - border, columns.min() + border : columns.max() - border] = True
    assert near[core].all(), "the wall shines through the card, or there are gaps in it"
    assert np.abs(got_m - true_m)[core].max() < 1.6e-3


def test_nothing_is_made_up_between_card_and_wall() -> None:
    got_m, _, _ = registered(CARD, KINECT_DEPTH, scaled(KINECT_COLOR, 2), BESIDE)
    there = got_m > 0
    assert (np.abs(got_m[there] - 0.9) < 0.01).sum() + (np.abs(got_m[there] - 1.4) < 0.02).sum() == there.sum()


def test_holes_stay_holes() -> None:
    mm = np.full((240, 320), 1000, np.uint16)
    mm[100:120, 150:170] = 0
    registration = Registration(KINECT_DEPTH, scaled(KINECT_COLOR, 2), BESIDE)
    filled = registration.apply(mm)
    inner = registration.apply(np.where(mm == 0, 1000, 0).astype(np.uint16))
    rows, columns = np.nonzero(inner)
    core = filled[rows.min() + 6 : rows.max() - 6, columns.min() + 6 : columns.max() - 6]
    assert not core.any()


def test_no_depth_gives_no_depth() -> None:
    assert not Registration(KINECT_DEPTH, KINECT_COLOR, BESIDE).apply(np.zeros((240, 320), np.uint16)).any()


@pytest.mark.parametrize(
    "pose",
    [
        Pose(rotation_from_vector(np.array([0.0, np.pi, 0.0])), np.zeros(3)),
        Pose(np.eye(3), np.array([0.0, 0.0, -50.0])),
        Pose(np.eye(3), np.array([300.0, 0.0, 0.0])),
    ],
)
def test_cameras_that_see_nothing_in_common_give_nothing(pose: Pose) -> None:
    depth_mm = np.random.default_rng(0).integers(0, 65536, (240, 320)).astype(np.uint16)
    assert not Registration(KINECT_DEPTH, KINECT_COLOR, pose).apply(depth_mm).any()


def test_any_depth_is_survived() -> None:
    noise = np.random.default_rng(1).integers(0, 65536, (240, 320)).astype(np.uint16)
    got = Registration(KINECT_DEPTH, KINECT_COLOR, BESIDE).apply(noise)
    assert got.max() <= 60000


def test_far_apart_cameras_are_projected_exactly() -> None:
    """Half a metre apart, a parabola in inverse depth no longer holds; the full projection stands in."""
    pose = Pose(rotation_from_vector(np.array([0.0, 0.3, 0.0])), np.array([-0.5, 0.05, 0.1]))
    registration = Registration(KINECT_DEPTH, KINECT_COLOR, pose)
    assert registration._polynomials is None
    got_m, true_m, _ = registered(WALL, KINECT_DEPTH, KINECT_COLOR, pose)
    there = (got_m > 0) & inside(got_m.shape, 0.02)
    assert there.sum() > 5_000
    assert np.abs(got_m - true_m)[there].max() < 3 * slope_m(true_m) + 1.5e-3


@settings(max_examples=15, deadline=None)
@given(
    turn=st.tuples(*[st.floats(-0.03, 0.03)] * 3),
    shift=st.tuples(st.floats(-0.08, 0.08), st.floats(-0.03, 0.03), st.floats(-0.02, 0.02)),
    k1=st.floats(-0.25, 0.25), wall_m=st.floats(0.6, 3.0),
)  # fmt: skip
def test_any_small_pose_and_lens(
    turn: tuple[float, float, float], shift: tuple[float, float, float], k1: float, wall_m: float
) -> None:
    depth = Intrinsics(160, 120, 145.0, 145.0, 79.5, 59.5, (-0.5 * k1, 0.05, 0.001, 0.0, 0.0))
    color = Intrinsics(160, 120, 131.0, 131.0, 80.0, 60.0, (k1, -0.1, 0.0, 0.001, 0.02))
    scene = Scene(np.array([0.1, 0.15, 0.98]), wall_m)
    got_m, true_m, _ = registered(scene, depth, color, Pose(rotation_from_vector(np.array(turn)), np.array(shift)))
    there = (got_m > 0) & inside(got_m.shape, 0.1)
    assert there.sum() > 0.3 * got_m.size
    assert np.abs(got_m - true_m)[there].max() < 3 * slope_m(true_m) + 1.5e-3


@pytest.mark.parametrize(
    "distortion",
    [(0.1, -0.2, 0.001, 0.002), (0.1, -0.2, 0.001, 0.002, 0.05), (0.1, -0.2, 0.001, 0.002, 0.05, 0.02, -0.1, 0.01),
     (0.1, -0.2, 0.001, 0.002, 0.05, 0.02, -0.1, 0.01, 0.003, -0.002, 0.001, 0.004),
     (0.1, -0.2, 0.001, 0.002, 0.05, 0.02, -0.1, 0.01, 0.003, -0.002, 0.001, 0.004, 0.02, -0.03)],
)  # fmt: skip
def test_lens_is_the_one_of_opencv(distortion: tuple[float, ...]) -> None:
    camera = Intrinsics(64, 48, 60.0, 61.0, 31.0, 23.0, distortion)
    x, y = (one.ravel() for one in np.meshgrid(np.linspace(-0.5, 0.5, 9), np.linspace(-0.4, 0.4, 9)))
    u, v = pixels_of_rays(camera, x, y)
    np.testing.assert_allclose(np.stack([u, v], 1), camera.project(np.stack([x, y, np.ones_like(x)], 1)), atol=1e-9)


def test_pixels_far_outside_do_not_fold_back_into_the_picture() -> None:
    u, _ = pixels_of_rays(KINECT_DEPTH, np.linspace(1.0, 50.0, 50), np.zeros(50))
    assert (u > KINECT_DEPTH.width).all()
