"""Lots that never ran: fruit of a simulated belt with true pictures, sizes made up from a seed."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import cv2
import numpy as np
from numpy.random import Generator

from fruitgui.frame import Frame
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.gui.theme.kinds import UNKNOWN
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.records.lot import LotPlan
from fruitgui.records.store import Store
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.fruit import Fruit
from fruitgui.station.live.crops import Cut, coded
from fruitgui.station.sink import Crop
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import station_value
from fruitgui.tracking.track import PathPoint

SEED = 11
KINDS: Mapping[str, tuple[float, float, float]] = {
    "lemon": (0.118e-3, 0.17, 0.44), "red apple": (0.182e-3, 0.14, 0.24), "green apple": (0.171e-3, 0.15, 0.16),
    "avocado, Chilean": (0.231e-3, 0.19, 0.13), UNKNOWN: (0.15e-3, 0.4, 0.03),
}  # fmt: skip
"""Mean volume in m³, its spread as a share, and how frequent each kind is."""

DENSITY_KG_M3 = {"lemon": 950.0, "red apple": 840.0, "green apple": 845.0}
LEAST_HEIGHT_M = 0.012
DAY_S = 86_400.0
NOW_S = 1_773_473_400.0
GROWERS = ("Fundo El Peñón", "Agrícola Los Aromos", "Hermanas Riquelme", "Viña Vieja", "Parcela 14")


@dataclass(frozen=True, slots=True, eq=False)
class Pictured:
    """The simulated rig, and the crops of its fruit by kind."""

    station: Station
    crops: Mapping[str, Sequence[tuple[Crop, ...]]]


@cache
def pictured() -> Pictured:
    """Return crops of rendered fruit, cut out where they rise from the belt."""
    crops: dict[str, list[tuple[Crop, ...]]] = {}
    simulation = still_scene(SEED, "opposed", 24, captures=1)
    frames, rig = list(simulation.frames()), simulation.rig()
    for true in simulation.truth.fruit:
        at_m = simulation.truth.position_m(true.fruit_id, 0.0)
        cuts = (_cut(frame, rig.mounts[frame.sensor], at_m, true.length_m) for frame in frames)
        found = coded(tuple(cut for cut in cuts if cut is not None))
        if found:
            crops.setdefault(true.kind, []).append(found)
    return Pictured(_station(rig), crops)


def _station(rig: Rig) -> Station:
    sensors = {name: StationSensor("", mount.pose, mount.surface) for name, mount in rig.mounts.items()}
    return Station(rig.reference, sensors, None, "models/model-0003.fruit")


def _cut(frame: Frame, mount: Mount, at_m: np.ndarray, length_m: float) -> Cut | None:
    """Return a fruit cut out of a frame; None where the frame does not show it."""
    middle_m = mount.pose.inverse().apply(at_m)
    u, v = frame.intrinsics.project(middle_m)[0]
    half = 0.75 * length_m * frame.intrinsics.fx / middle_m[2]
    x0, x1, y0, y1 = (round(one) for one in (u - half, u + half, v - half, v + half))
    if x0 < 0 or y0 < 0 or x1 > frame.intrinsics.width or y1 > frame.intrinsics.height:
        return None
    depth_mm = frame.depth_mm[y0:y1, x0:x1]
    z_m = depth_mm / 1e3
    rays = frame.intrinsics.rays()[y0:y1, x0:x1]
    points_m = np.dstack([rays * z_m[..., None], z_m])
    raised = (mount.surface.plane.height_m(points_m) > LEAST_HEIGHT_M) & (depth_mm > 0)
    mask = cv2.morphologyEx(raised.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    if not contours:
        return None
    outline = cv2.convexHull(max(contours, key=cv2.contourArea)).reshape(-1, 2).astype(np.float32)
    color = frame.color[y0:y1, x0:x1].copy()
    box_px = (x0, y0, x1 - x0, y1 - y0)
    return Cut(frame.sensor, frame.time_s, box_px, x0, y0, color, depth_mm.copy(), outline, 1.0)


def made_fruit(rng: Generator, number: int, kind: str) -> Fruit:
    """Return a fruit of a kind: sizes as its kind has them, errors as a rig of Kinects has them."""
    mean_m3, spread, _ = KINDS[kind]
    volume = Quantity(float(mean_m3 * np.exp(rng.normal(0.0, spread))), float(mean_m3 * rng.uniform(0.012, 0.03)))
    diameter_m = float((6 * volume.value / np.pi / rng.uniform(1.05, 1.3)) ** (1 / 3))
    length_m = float(6 * volume.value / np.pi / diameter_m**2)
    std_m = float(rng.uniform(0.0006, 0.0014))
    size = Size(
        Quantity(volume.value * 1.02, volume.std), Quantity(length_m, std_m), Quantity(diameter_m, std_m),
        Quantity(3.2 * diameter_m, 2 * std_m), float(rng.uniform(0.5, 0.8)), None, float(rng.uniform(0.0, 0.2)),
    )  # fmt: skip
    density = DENSITY_KG_M3.get(kind)
    mass = None if density is None else Quantity(volume.value * density, volume.std * density * 1.3)
    sure = float(1.0 - rng.beta(1.2, 14.0))
    return Fruit(number, kind, sure, size, volume, mass, None, int(rng.integers(18, 30)), _path(rng, number))


def _path(rng: Generator, number: int) -> tuple[PathPoint, ...]:
    plane = pictured().station.sensors[pictured().station.reference].surface.plane
    to_reference = plane.frame().inverse()
    start = np.array([-0.45, rng.uniform(-0.15, 0.15), 0.03])
    times_s = np.linspace(0.0, 1.8, 13)
    covariance = to_reference.rotation @ np.diag([4e-6, 2e-6, 1e-6]) @ to_reference.rotation.T
    return tuple(
        PathPoint(
            number * 0.4 + time_s,
            to_reference.apply(
                start + np.array([0.5 * time_s, 0.004 * np.sin(4 * time_s), 0.0]) + rng.normal(0, 8e-4, 3)
            ),
            covariance * rng.uniform(0.7, 1.6),
        )
        for time_s in times_s
    )


def run_lot(store: Store, name: str, grower: str, fruit: int, seed: int, recipe: str = "") -> int:
    """Run a lot of so many fruit; it stays open. Return its key."""
    rng = np.random.default_rng(seed)
    station = pictured().station
    text = json.dumps(station_value(station))
    lot = store.lots.start(LotPlan(name, grower, recipe, "", station.reference, text, station.model))
    kinds = rng.choice(list(KINDS), size=fruit, p=[share for _, _, share in KINDS.values()])
    store.counting.commit_batch(
        lot.key, [(made_fruit(rng, at + 1, str(kind)), _crops_of(rng, str(kind))) for at, kind in enumerate(kinds)]
    )
    return lot.key


def _crops_of(rng: Generator, kind: str) -> tuple[Crop, ...]:
    crops = pictured().crops
    there = crops.get(kind) or [one for found in crops.values() for one in found]
    return there[int(rng.integers(len(there)))]
