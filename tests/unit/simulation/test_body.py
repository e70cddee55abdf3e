"""Bodies rest on the belt, touch without entering each other, and lie apart where they should."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.simulation.body import Body, at_rest, push_together
from fruitgui.simulation.fruit import KINDS, ball
from fruitgui.simulation.mesh import Mesh
from fruitgui.simulation.motion import Wobble
from fruitgui.simulation.packing import clusters, scatter, stream
from fruitgui.simulation.stock import STRANGE, made_restless, make_body, mixed


def clearance_m(first: Body, second: Body) -> float:
    """Return the least signed distance of either's vertices to the other's surface, negative inside."""
    return min(_least(first, second), _least(second, first))


def _least(still: Body, other: Body) -> float:
    import open3d as o3d

    apart = np.array([*other.start_m, other.rest_m()]) - np.array([*still.start_m, still.rest_m()])
    scene = o3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(_tensor(still.mesh.vertices_m, np.float32), _tensor(still.mesh.triangles, np.uint32))
    points = _tensor(other.mesh.vertices_m + apart, np.float32)
    return float(scene.compute_signed_distance(points, nthreads=1).numpy().min())


def _tensor(values: np.ndarray, kind: type) -> object:
    import open3d as o3d

    return o3d.core.Tensor(np.ascontiguousarray(values, dtype=kind))


@pytest.mark.parametrize("kind", [*KINDS, "pear", *STRANGE])
def test_a_body_rests_in_a_stable_orientation(kind: str) -> None:
    rng = np.random.default_rng(3)
    body = make_body(kind, rng)
    lowest = [body.rest_m()]
    for _ in range(60):
        tilt = rotation_from_vector(0.03 * np.append(rng.normal(size=2), 0.0))
        lowest.append(body.at((0.0, 0.0)).mesh.turned(tilt).vertices_m[:, 2].min() * -1)
    # facets make the bottom a little flat: leave 0.05 mm
    assert lowest[0] <= min(lowest) + 5e-5


@pytest.mark.parametrize("seed", range(6))
def test_touching_is_contact_without_entering(seed: int) -> None:
    rng = np.random.default_rng(seed)
    kinds = [*KINDS, "pear"]
    standing = make_body(kinds[seed], rng).at((0.03, -0.02))
    moving = push_together([standing], standing, make_body(kinds[(seed + 2) % 6], rng), rng.uniform(0, 6.28))
    # vertices meet facets; between vertices a facet's edge may enter by its sagitta: 40 mm · (2°)²/2 = 0.02 mm
    assert clearance_m(standing, moving) == pytest.approx(0.0, abs=5e-5)


def test_two_balls_touch_at_the_sum_of_their_radii() -> None:
    first = Body(1, "ball", ball(0.04, (1, 0, 0)), (0.0, 0.0))
    second = push_together([first], first, Body(2, "ball", ball(0.04, (1, 0, 0)), (0.0, 0.0)), 0.7)
    assert np.hypot(*second.start_m) == pytest.approx(0.08, abs=2e-4)
    assert np.arctan2(second.start_m[1], second.start_m[0]) == pytest.approx(0.7)


def test_the_asked_share_touches_and_nothing_else() -> None:
    rng = np.random.default_rng(8)
    bodies = mixed(rng, 36, KINDS, 0)
    laid = stream(clusters(bodies, 1 / 3, rng), 0.28, 14.0, rng)
    assert len(laid) == 36
    assert 10 <= sum(body.touching for body in laid) <= 12
    for number, body in enumerate(laid):
        near = [o for o in laid[number + 1 :] if np.hypot(*np.subtract(body.start_m, o.start_m)) < 0.16]
        gaps = [clearance_m(body, other) for other in near]
        assert min(gaps, default=1.0) > -5e-5
        if not body.touching:
            assert min(gaps, default=1.0) > 0.002


def test_a_moving_fruit_stays_on_the_belt_and_comes_to_no_other() -> None:
    rng = np.random.default_rng(2)
    bodies = [made_restless(body, rng) for body in mixed(rng, 14, KINDS, 0)]
    laid = scatter(clusters(bodies, 0.0, rng), np.array([-0.5, -0.28]), np.array([0.5, 0.28]), rng)
    for time_s in (0.0, 0.3, 0.8, 1.5, 4.0):
        poses = [body.pose(time_s, 0.0) for body in laid]
        points = [pose.apply(body.mesh.vertices_m) for pose, body in zip(poses, laid, strict=True)]
        for some in points:
            assert some[:, 2].min() == pytest.approx(0.0, abs=1e-12)
            assert np.abs(some[:, 1]).max() < 0.28
        for number, some in enumerate(points):
            for other in points[number + 1 :]:
                assert _apart(some, other)


def _apart(first: np.ndarray, second: np.ndarray) -> bool:
    """Tell whether the outlines from above can be parted by a line at right angles to that between their middles."""
    way = second.mean(axis=0)[:2] - first.mean(axis=0)[:2]
    return bool((first[:, :2] @ way).max() < (second[:, :2] @ way).min() + 1e-9)


def test_a_shoved_body_jumps_once() -> None:
    body = Body(1, "ball", ball(0.03, (1, 0, 0)), (0.1, 0.0), jump_m=(0.02, -0.01), jump_s=1.0)
    assert body.pose(0.99, 0.0).translation_m[:2].tolist() == pytest.approx([0.1, 0.0])
    assert body.pose(1.0, 0.5).translation_m[:2].tolist() == pytest.approx([0.62, -0.01])


def test_rest_finds_the_flat_side() -> None:
    rng = np.random.default_rng(1)
    corners = np.array([[x, y, z] for x in (-3, 3) for y in (-2, 2) for z in (-1, 1)]) * 0.02
    flat = Mesh(corners, np.zeros((0, 3), dtype=np.intp), np.ones((8, 3), np.float32))
    rested = at_rest(flat, rng, 0.2)
    assert -rested.vertices_m[:, 2].min() == pytest.approx(0.02, abs=1e-4)


def test_rocking_needs_no_table() -> None:
    body = Body(1, "ball", ball(0.03, (1, 0, 0)), (0.0, 0.0), Wobble(rock_rad=0.2))
    assert body.pose(0.2, 0.0).apply(body.mesh.vertices_m)[:, 2].min() == pytest.approx(0.0, abs=1e-12)
