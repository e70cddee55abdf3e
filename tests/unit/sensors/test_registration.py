"""Depth of a camera of its own, brought into the colour picture, against rays cast from the colour camera itself."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
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


@dataclass(frozen=True)
class Balls:
    """Balls over a wall, in the depth camera's frame, whose rims are as steep as fruit's."""

    centres_m: F64
    radii_m: F64
    wall_m: float = 0.9

    def depth_m(self, camera: Intrinsics, to_scene: Pose) -> tuple[F64, np.ndarray]:
        """Return (z along the camera's axis, which ball is seen or -1), (height, width) each."""
        rays = camera.rays().astype(np.float64)
        directions = to_scene.rotation @ np.vstack([rays.reshape(-1, 2).T, np.ones(rays[..., 0].size)])
        origin = to_scene.translation_m
        z, whose = (self.wall_m - origin[2]) / directions[2], np.full(rays[..., 0].size, -1)
        a = (directions * directions).sum(axis=0)
        for n, (centre, radius) in enumerate(zip(self.centres_m, self.radii_m, strict=True)):
            apart = origin - centre
            b = apart @ directions
            inside_2 = b * b - a * (apart @ apart - radius * radius)
            met = np.flatnonzero(inside_2 > 0)
            there = (-b[met] - np.sqrt(inside_2[met])) / a[met]
            before = there < z[met]
            z[met[before]], whose[met[before]] = there[before], n
        return z.reshape(rays.shape[:2]), whose.reshape(rays.shape[:2])


def balls(seed: int) -> Balls:
    """Two dozen, of 50 to 90 mm, most of them in both pictures."""
    rng = np.random.default_rng(seed)
    places = np.array([[x, y, 0.85] for x in (-0.4, -0.24, -0.08, 0.08, 0.24, 0.4) for y in (-0.26, -0.09, 0.09, 0.26)])
    return Balls(places + rng.uniform(-0.02, 0.02, places.shape), rng.uniform(0.025, 0.045, len(places)))


ABOVE_WALL_M = 0.012
"""What is so much nearer than the wall is a ball's: more than the noise and the rounding of the wall."""


def outline_moved_px(got_m: F64, true_m: F64, whose: np.ndarray, wall_m: F64) -> float:
    """Return how far outlines moved outward on average, colour pixels: from the areas, and the radii these make."""
    near, true = (got_m > 0) & (got_m < wall_m - ABOVE_WALL_M), (whose >= 0) & (true_m < wall_m - ABOVE_WALL_M)
    moved = []
    for n in range(whose.max() + 1):
        rows, columns = np.nonzero(whose == n)
        if len(rows) and rows.min() > 4 and columns.min() > 4:
            around = np.s_[rows.min() - 4 : rows.max() + 5, columns.min() - 4 : columns.max() + 5]
            if rows.max() + 5 <= whose.shape[0] and columns.max() + 5 <= whose.shape[1]:
                moved.append(np.sqrt(near[around].sum() / np.pi) - np.sqrt(true[around].sum() / np.pi))
    assert len(moved) >= 12
    return float(np.mean(moved))


SIDE_BY_SIDE = Pose(rotation_from_vector(np.radians([0.4, -0.6, 0.3])), np.array([0.025, 0.002, -0.003]))
STRAIGHT = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
BENT = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5, (0.12, -0.25, 0.001, -0.0008, 0.1))
BENT_DEPTH = (0.09, -0.27, 0.0, 0.0, 0.095)


def depth_camera(ratio: float, distortion: tuple[float, ...] = ()) -> Intrinsics:
    """A depth camera whose pixels are `ratio` of the colour camera's across, seeing somewhat more."""
    width, height, f = round(736 / ratio), round(552 / ratio), 525.0 / ratio
    return Intrinsics(width, height, f, f, width / 2 - 0.2, height / 2 - 0.5, distortion)


@pytest.mark.parametrize(("pose", "bent"), [(Pose.exact(), False), (SIDE_BY_SIDE, True)])
@pytest.mark.parametrize("ratio", [0.5, 0.75, 0.94, 1.0, 1.44, 2.0, 3.0])
def test_things_keep_their_size(ratio: float, pose: Pose, bent: bool) -> None:
    """Drawn as points they grew by 0.3 px a side at half the pixel, and shrank by 0.3 px at 1.44, 0.7 px at twice.

    One ball's outline is uncertain by about 0.1 px a side, since pixels are whole; twenty of them by 0.02 px.
    """
    depth, color = depth_camera(ratio, BENT_DEPTH if bent else ()), BENT if bent else STRAIGHT
    scene = balls(0)
    mm = np.rint(scene.depth_m(depth, Pose.exact())[0] * 1000.0).astype(np.uint16)
    true_m, whose = scene.depth_m(color, pose.inverse())
    wall_m = replace(scene, centres_m=np.zeros((0, 3)), radii_m=np.zeros(0)).depth_m(color, pose.inverse())[0]
    got_m = Registration(depth, color, pose).apply(mm) / 1000.0
    assert abs(outline_moved_px(got_m, true_m, whose, wall_m)) < (0.08 if ratio <= 2 else 0.12)


@settings(max_examples=8, deadline=None)
@given(ratio=st.floats(0.5, 2.0), aside_m=st.floats(-0.06, 0.06), up_m=st.floats(-0.02, 0.02),
       roll=st.floats(-0.05, 0.05), k1=st.floats(-0.2, 0.2), seed=st.integers(0, 10_000))  # fmt: skip
def test_things_keep_their_size_with_any_cameras(
    ratio: float, aside_m: float, up_m: float, roll: float, k1: float, seed: int
) -> None:
    depth, color = (
        depth_camera(ratio, (0.5 * k1, -0.05, 0.0, 0.0)),
        replace(STRAIGHT, distortion=(k1, -0.1, 0.001, 0.0)),
    )
    pose, scene = Pose(rotation_from_vector(np.array([0.0, 0.0, roll])), np.array([aside_m, up_m, 0.0])), balls(seed)
    mm = np.rint(scene.depth_m(depth, Pose.exact())[0] * 1000.0).astype(np.uint16)
    true_m, whose = scene.depth_m(color, pose.inverse())
    got_m = Registration(depth, color, pose).apply(mm) / 1000.0
    wall_m = np.full(true_m.shape, scene.wall_m)
    assert abs(outline_moved_px(got_m, true_m, whose, wall_m)) < 0.2


@pytest.mark.parametrize("roll_deg", [0.0, 3.0])
@pytest.mark.parametrize("ratio", [0.5, 0.92, 1.44, 3.0])
def test_slopes_and_turned_pictures_have_no_cracks(ratio: float, roll_deg: float) -> None:
    roll = rotation_from_vector(np.radians([0.0, 0.0, roll_deg]))
    pose, depth = Pose(SIDE_BY_SIDE.rotation @ roll, SIDE_BY_SIDE.translation_m), depth_camera(ratio, BENT_DEPTH)
    scene, rng = balls(1), np.random.default_rng(1)
    seen_m = scene.depth_m(depth, Pose.exact())[0]
    mm = np.rint((seen_m + rng.normal(0.0, 0.0012, seen_m.shape)) * 1000.0).astype(np.uint16)
    true_m, whose = scene.depth_m(BENT, pose.inverse())
    got_m = Registration(depth, BENT, pose).apply(mm) / 1000.0
    within = cv2.erode((whose >= 0).astype(np.uint8), np.ones((2 * round(ratio) + 3,) * 2)) > 0
    open_or_wall = within & ((got_m == 0) | (got_m > true_m + 0.02))
    assert within.sum() > 20_000
    assert open_or_wall.sum() <= 2e-4 * within.sum()


@settings(max_examples=25, deadline=None)
@given(ratio=st.floats(0.5, 3.0), aside_m=st.floats(-0.05, 0.05), half_m=st.floats(0.05, 0.12))
def test_nothing_bleeds_over_a_jump(ratio: float, aside_m: float, half_m: float) -> None:
    """No depth between card and wall, and no card farther out than half a pixel of each camera.

    An edge may also come to lie a quarter of half a reading farther out, as across a slope.
    """
    scene, pose = Scene(np.array([0.0, 0.0, 1.0]), 1.4, 0.9, half_m), Pose(np.eye(3), np.array([aside_m, 0.0, 0.0]))
    color = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
    depth = Intrinsics(round(360 / ratio), round(280 / ratio), 262.5 / ratio, 262.5 / ratio, 180 / ratio, 140 / ratio)
    got_m, _, card = registered(scene, depth, color, pose)
    on_card, on_wall = np.abs(got_m - 0.9) < 1e-3, np.abs(got_m - 1.4) < 1e-3
    assert (on_card | on_wall | (got_m == 0)).all()
    reach_px = int(np.ceil(0.5 + 0.625 * ratio))
    assert not on_card[cv2.dilate(card.astype(np.uint8), np.ones((2 * reach_px + 1,) * 2)) == 0].any()
    assert on_card[cv2.erode(card.astype(np.uint8), np.ones((2 * reach_px + 1,) * 2)) > 0].all()


@pytest.mark.parametrize("ratio", [0.5, 0.8, 1.0, 1.44, 2.0])
def test_holes_keep_their_size(ratio: float) -> None:
    color, depth = STRAIGHT, depth_camera(ratio)
    v, u = np.mgrid[: depth.height, : depth.width]
    pitch, radius = 60.0 / ratio, 20.3 / ratio
    holes = ((u + 0.37) % pitch - pitch / 2) ** 2 + ((v + 0.11) % pitch - pitch / 2) ** 2 < radius**2
    got = Registration(depth, color, Pose.exact()).apply(np.where(holes, 0, 1000).astype(np.uint16))
    part, true_part = (got == 0).mean(), np.pi * 20.3**2 / 60.0**2
    # 88 holes, some of them cut by the picture's edge
    assert part == pytest.approx(true_part, rel=2 * 0.15 / 20.3 + 0.02)


@pytest.mark.parametrize(("width", "height"), [(1, 1), (1, 40), (40, 1), (2, 2)])
def test_the_smallest_pictures_are_survived(width: int, height: int) -> None:
    tiny = Intrinsics(width, height, 50.0, 50.0, width / 2, height / 2)
    for depth, color in ((tiny, KINECT_COLOR), (KINECT_DEPTH, tiny)):
        got = Registration(depth, color, BESIDE).apply(np.full((depth.height, depth.width), 1000, np.uint16))
        assert got.shape == (color.height, color.width)


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
