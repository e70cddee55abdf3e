"""The truth of a scene in the product's own file formats: labels, stations and poses."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tests.second_rig.camera import project, relative, sees
from tests.second_rig.scene import Actor, Eye, Scene


def true_station(scene: Scene, reference: str | None = None) -> dict[str, Any]:
    """Return a station with the true poses and surfaces."""
    first = next(eye for eye in scene.eyes if reference in (None, eye.name))
    sensors = {}
    for eye in scene.eyes:
        rotation, translation = relative(first.stand, eye.stand)
        normal = eye.stand.rotation.T @ [0.0, 0.0, 1.0]
        sensors[eye.name] = {
            "serial": None,
            "pose": {"rotation": rotation.tolist(), "translation_m": translation.tolist(), "covariance": None},
            "surface": {
                "normal": normal.tolist(),
                "offset_m": float(eye.stand.centre_m[2]),
                "region": _region(scene, eye),
            },
            "clock_offset_s": -eye.clock_s,
            "depth_correction": None,
            "quality": {},
        }
    return {
        "schema": "fruitgui.station/1", "reference_sensor": first.name, "sensors": sensors,
        "belt": {"velocity_m_s": None}, "model": None,
    }  # fmt: skip


def write_station(path: Path, scene: Scene) -> Path:
    """Write the true station; return its path."""
    path.write_text(json.dumps(true_station(scene)))
    return path


def write_labels(
    path: Path, scene: Scene, *, per_fruit: int = 8, volumes: float = 1 / 3, with_fruit: bool = False
) -> Path:
    """Write what a careful operator would: some points on every fruit, the volume of each third one."""
    rng = np.random.default_rng([scene.seed, 6])
    measured = set(rng.permutation(len(scene.actors))[: round(volumes * len(scene.actors))].tolist())
    rows: list[list[Any]] = []
    for place, actor in enumerate(scene.actors):
        seen = sightings(scene, actor)
        for number in np.unique(np.linspace(0, len(seen) - 1, min(per_fruit, len(seen))).round().astype(int)):
            time, eye = seen[number]
            pixel = project(eye.lens, eye.stand.inward(scene.centre_m(actor, time)[None]))[0]
            volume = f"{actor.thing.truth.volume_m3 * 1e6:.1f}" if place in measured else ""
            row = [
                eye.name,
                f"{scene.stamp_s(eye, time):.6f}",
                f"{pixel[0]:.1f}",
                f"{pixel[1]:.1f}",
                actor.thing.kind,
                volume,
            ]
            rows.append([*row, f"f{actor.number}"] if with_fruit else row)
    with path.open("w", newline="") as sink:
        writer = csv.writer(sink)
        writer.writerow(["sensor", "time_s", "u_px", "v_px", "kind", "volume_ml", *(["fruit"] if with_fruit else [])])
        writer.writerows(rows)
    return path


def sightings(scene: Scene, actor: Actor, margin_px: float = 55.0) -> list[tuple[float, Eye]]:
    """Return the captures (true time, sensor) that show a thing well inside the picture."""
    captures = scene.captures()
    return [(time, eye) for time, _, eye in captures
            if sees(eye.lens, eye.stand, scene.centre_m(actor, time)[None], margin_px)[0]]  # fmt: skip


def write_poses(path: Path, rows: Sequence[tuple[float, Eye]]) -> Path:
    """Write a poses file of sensors at times; return its path."""
    from scipy.spatial.transform import Rotation

    with path.open("w", newline="") as sink:
        writer = csv.writer(sink)
        writer.writerow(["time_s", "sensor", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"])
        for time, eye in rows:
            turn = Rotation.from_matrix(eye.stand.rotation).as_quat()
            writer.writerow([f"{time:.6f}", eye.name, *(f"{v:.9f}" for v in [*eye.stand.centre_m, *turn])])
    return path


def _region(scene: Scene, eye: Eye) -> list[list[float]]:
    """Return the belt's part under a sensor as a polygon in its optical frame."""
    half, middle = scene.setting.width_m / 2, float(eye.stand.centre_m[0])
    corners = np.array([[middle + x, y, 0.0] for x, y in ((-0.9, -half), (0.9, -half), (0.9, half), (-0.9, half))])
    return [[float(v) for v in corner] for corner in eye.stand.inward(corners)]
