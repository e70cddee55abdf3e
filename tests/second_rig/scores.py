"""Compares what the product says with the truth."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.second_rig.bodies import F64
from tests.second_rig.camera import Stand, relative, sees
from tests.second_rig.produce import KINDS
from tests.second_rig.scene import Actor, Eye, Scene


@dataclass(frozen=True, slots=True)
class PoseError:
    """How wrong one sensor's pose is.

    Attributes:
        shift_mm: mean displacement over the belt area that it sees together with `against`.
    """

    sensor: str
    against: str
    shift_mm: float
    angle_deg: float


def pose_errors(scene: Scene, station: dict[str, Any]) -> list[PoseError]:
    """Return the error of every sensor's pose in the reference sensor's frame.

    It is taken over the belt area that the sensor shares with the reference sensor or,
    where they share none, with any other.
    """
    eyes = {eye.name: eye for eye in scene.eyes}
    first = eyes[station["reference_sensor"]]
    errors = []
    for name in station["sensors"]:
        if name == first.name:
            continue
        others = [first, *(eye for eye in scene.eyes if eye.name not in (name, first.name))]
        areas = ((other, _shared(scene, eyes[name], other)) for other in others)
        against, area = next(((other, area) for other, area in areas if len(area) > 20), (first, np.zeros((0, 3))))
        if len(area):
            said = _stand(station["sensors"][name]["pose"])
            errors.append(_error(said, first, eyes[name], area, against.name))
    return errors


def _error(said: Stand, first: Eye, second: Eye, area_m: F64, against: str) -> PoseError:
    true_rotation, _ = relative(first.stand, second.stand)
    gap = said.outward(second.stand.inward(area_m)) - first.stand.inward(area_m)
    turn = said.rotation @ true_rotation.T
    axis = [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
    angle = math.degrees(math.atan2(float(np.linalg.norm(axis)), float(np.trace(turn)) - 1.0))
    return PoseError(second.name, against, float(np.linalg.norm(gap, axis=1).mean()) * 1e3, angle)


def _stand(pose: dict[str, Any]) -> Stand:
    return Stand(np.array(pose["rotation"], dtype=float), np.array(pose["translation_m"], dtype=float))


def _shared(scene: Scene, first: Eye, second: Eye) -> F64:
    half = scene.setting.width_m / 2
    x, y = np.meshgrid(np.arange(-2.0, 6.0, 0.02), np.arange(-half, half, 0.02))
    belt = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    return belt[sees(first.lens, first.stand, belt) & sees(second.lens, second.stand, belt)]


@dataclass(frozen=True, slots=True)
class Match:
    """One thing on the belt and what the report says of it (None: nothing)."""

    actor: Actor
    said: dict[str, Any] | None


@dataclass(frozen=True, slots=True)
class Account:
    """A whole report against the truth.

    Attributes:
        doubles: records of things that another record has already.
        ghosts: records near nothing.
    """

    matches: tuple[Match, ...]
    doubles: tuple[dict[str, Any], ...]
    ghosts: tuple[dict[str, Any], ...]

    @property
    def lost(self) -> list[Actor]:
        """Things without a record."""
        return [match.actor for match in self.matches if match.said is None]


def account(scene: Scene, report: dict[str, Any], gate_m: float = 0.045) -> Account:
    """Pair records with things by the distance between their paths, each with at most one."""
    from scipy.optimize import linear_sum_assignment

    reference = next(eye for eye in scene.eyes if eye.name == report["reference_sensor"])
    records = report["fruit"]
    gaps = np.full((len(records), len(scene.actors)), 9.0)
    for row, said in enumerate(records):
        times = [point["time_s"] - scene.start_s - reference.clock_s for point in said["path"]]
        places = reference.stand.outward(
            np.array([point["position_m"] for point in said["path"]], dtype=float).reshape(-1, 3)
        )
        for column, actor in enumerate(scene.actors):
            truth = np.array([scene.centre_m(actor, time) for time in times]).reshape(-1, 3)
            if len(truth):
                gaps[row, column] = float(np.median(np.linalg.norm(places - truth, axis=1)))
    rows, columns = linear_sum_assignment(np.minimum(gaps, gate_m * 2))
    paired = {int(c): int(r) for r, c in zip(rows, columns, strict=True) if gaps[r, c] < gate_m}
    matches = tuple(Match(actor, records[paired[n]] if n in paired else None) for n, actor in enumerate(scene.actors))
    rest = [n for n in range(len(records)) if n not in paired.values()]
    close = [n for n in rest if len(scene.actors) and gaps[n].min() < 2 * gate_m]
    return Account(matches, tuple(records[n] for n in close), tuple(records[n] for n in rest if n not in close))


def measured(found: Account) -> list[dict[str, float | str | bool]]:
    """Return, for every trained fruit that has a record, its errors."""
    rows: list[dict[str, float | str | bool]] = []
    for match in found.matches:
        if match.said is None or match.actor.thing.kind not in KINDS:
            continue
        truth, said = match.actor.thing.truth, match.said
        volume = truth.volume_m3 * 1e6
        row: dict[str, float | str | bool] = {
            "number": match.actor.number, "kind": match.actor.thing.kind, "said": said["kind"],
            "right": said["kind"] == match.actor.thing.kind, "unknown": said["kind"] == "unknown",
            "views": said["views"],
        }  # fmt: skip
        if said.get("volume_ml") is not None:
            row["volume"] = (said["volume_ml"] - volume) / volume
            row["held"] = abs(said["volume_ml"] - volume) <= 1.96 * said["volume_std_ml"]
        for name, true_m in (("length", truth.length_m), ("diameter", truth.diameter_m)):
            if said.get(f"{name}_mm") is not None:
                row[name] = said[f"{name}_mm"] - true_m * 1e3
                row[f"{name}_held"] = abs(float(row[name])) <= 1.96 * said[f"{name}_std_mm"]
        rows.append(row)
    return rows


def rate(hits: Iterable[bool]) -> tuple[float, float, float, int]:
    """Return a share with Wilson's 95 % interval and the number of trials."""
    found = list(hits)
    n, z = len(found), 1.96
    if not n:
        return math.nan, math.nan, math.nan, 0
    p = sum(found) / n
    middle = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n)
    return p, max(middle - half, 0.0), min(middle + half, 1.0), n


def mean(values: Sequence[float], seed: int = 0) -> tuple[float, float, float, int]:
    """Return a mean with its bootstrap 95 % interval and the number of values."""
    if not values:
        return math.nan, math.nan, math.nan, 0
    data = np.asarray(values, dtype=float)
    draws = np.random.default_rng(seed).choice(data, (1000, len(data))).mean(axis=1)
    return float(data.mean()), float(np.quantile(draws, 0.025)), float(np.quantile(draws, 0.975)), len(data)
