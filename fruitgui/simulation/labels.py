"""Labels as an operator would make them, for training and evaluating."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.random import Generator

from fruitgui.files import written_whole
from fruitgui.frame import Bools
from fruitgui.geometry.pose import Pose
from fruitgui.simulation.simulation import Capture, Simulation

SMALLEST_PX = 120
"""An operator does not label what shows fewer pixels than this."""

FIELDS = ("sensor", "time_s", "u_px", "v_px", "kind", "volume_ml", "fruit")


@dataclass(frozen=True, slots=True)
class TrueLabel:
    """One row of a labels file.

    Attributes:
        sensor: the sensor's id.
        time_s: stamp of the frame, in the sensor's own clock.
        u_px, v_px: a point on the fruit where it is seen, in the colour picture.
        kind: what it is.
        volume_ml: measured volume; None where the operator measured none.
        fruit: says which rows are the same piece.
    """

    sensor: str
    time_s: float
    u_px: float
    v_px: float
    kind: str
    volume_ml: float | None
    fruit: str


def truth_labels(
    sim: Simulation,
    *,
    per_fruit: int = 3,
    volume_share: float = 1 / 3,
    beaker_std: float = 0.0,
    seed: int = 0,
) -> list[TrueLabel]:
    """Return labels of a scene's fruit, in order of time; foreign objects have none.

    Args:
        sim: the scene.
        per_fruit: views labelled of each piece, spread over its passage (fewer where it is seen less often).
        volume_share: share of each kind's pieces whose volume is given.
        beaker_std: relative standard deviation of the volume as measured.
        seed: of the operator's choices.
    """
    rng = np.random.default_rng([seed, 77])
    chosen = {thing.fruit_id: thing for thing in sim.truth.fruit if not thing.foreign}
    measured = _measured(sim, list(chosen), volume_share, beaker_std, rng)
    views: dict[int, list[int]] = {}
    for fruit_id in chosen:
        for number in _spread(_seen_whole(sim, fruit_id), per_fruit, rng):
            views.setdefault(number, []).append(fruit_id)
    rows: list[TrueLabel] = []
    for number in sorted(views):
        capture = sim.captures[number]
        for fruit_id, (u, v) in _points(sim, capture, views[number], rng).items():
            stamp_s = capture.time_s - sim.device(capture.sensor).clock_offset_s
            name = f"f{fruit_id:04d}"
            rows.append(TrueLabel(capture.sensor, stamp_s, u, v, chosen[fruit_id].kind, measured.get(fruit_id), name))
    return rows


def write_labels(path: Path, rows: Sequence[TrueLabel]) -> None:
    """Write a labels file.

    Raises:
        WorldError: it cannot be written.
    """
    with written_whole(path) as beside, beside.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(FIELDS)
        for row in rows:
            volume = "" if row.volume_ml is None else f"{row.volume_ml:.2f}"
            place = (f"{row.u_px:.1f}", f"{row.v_px:.1f}")
            writer.writerow((row.sensor, f"{row.time_s:.9f}", *place, row.kind, volume, row.fruit))


def _measured(sim: Simulation, ids: Sequence[int], share: float, beaker_std: float, rng: Generator) -> dict[int, float]:
    """Return the volumes (ml) of as many pieces of each kind as the share says, at least one if it is not zero."""
    by_kind: dict[str, list[int]] = {}
    volumes_ml = {thing.fruit_id: thing.volume_m3 * 1e6 for thing in sim.truth.fruit}
    kinds = {thing.fruit_id: thing.kind for thing in sim.truth.fruit}
    for fruit_id in ids:
        by_kind.setdefault(kinds[fruit_id], []).append(fruit_id)
    picked: dict[int, float] = {}
    for of_kind in by_kind.values():
        count = int(np.ceil(share * len(of_kind)))
        for fruit_id in rng.permutation(of_kind)[:count].tolist():
            picked[fruit_id] = volumes_ml[fruit_id] * (1 + beaker_std * float(rng.normal()))
    return picked


def _seen_whole(sim: Simulation, fruit_id: int) -> list[int]:
    """Return the captures in whose colour picture a body is wholly inside."""
    body = next(body for body in sim.scene.bodies if body.fruit_id == fruit_id)
    rim_m = body.mesh.vertices_m[:: max(len(body.mesh.vertices_m) // 60, 1)]
    inside = []
    for number, capture in enumerate(sim.captures):
        device = sim.device(capture.sensor)
        to_sensor: Pose = device.pose.inverse() @ sim.truth.pose_in_world(fruit_id, capture.time_s)
        points = to_sensor.apply(rim_m)
        pixels = device.color_camera.project(points) if points[:, 2].min() > 0.1 else np.full((1, 2), -1.0)
        size = (device.color_camera.width, device.color_camera.height)
        margin = 0.06 * np.array(size)
        if (pixels > margin).all() and (pixels < size - margin).all():
            inside.append(number)
    return inside


def _spread(seen: Sequence[int], count: int, rng: Generator) -> list[int]:
    """Return about evenly spaced ones of the captures, a little at random."""
    if len(seen) <= count:
        return list(seen)
    places = (np.arange(count) + rng.uniform(0.1, 0.9, count)) / count * len(seen)
    return [seen[int(place)] for place in places]


def _points(sim: Simulation, capture: Capture, ids: Sequence[int], rng: Generator) -> dict[int, tuple[float, float]]:
    """Return a pixel well inside what is seen of each body; bodies that are mostly hidden are left out."""
    import cv2

    bodies = sim.in_sight(capture)
    who = sim.eye(capture.sensor).who(bodies)
    points = {}
    for number, placed in enumerate(bodies):
        if placed.body.fruit_id not in ids:
            continue
        seen: Bools = who == number
        if np.count_nonzero(seen) < SMALLEST_PX:
            continue
        depth = cv2.distanceTransform(seen.astype(np.uint8), cv2.DIST_L2, 3)
        rows, columns = np.nonzero(depth > 0.6 * depth.max())
        pick = int(rng.integers(len(rows)))
        points[placed.body.fruit_id] = (float(columns[pick]), float(rows[pick]))
    return points
