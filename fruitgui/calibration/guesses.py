"""First guesses of the pose between two views of any scene, with no belt and no hint.

Places that look alike by their shape (FPFH, Rusu 2009) are taken together; of these, sets that keep their
distances to one another, and whose members agree on who keeps them (second-order consistency, Chen et al. 2022,
"SC²-PCR"), give poses. No chance is involved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.patches import Patches
from fruitgui.frame import F32, F64, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import nearest_rotation

MOST_GUESSES = 4
MOST_ALIKE = 500
SEEDS = 120
CIRCLE = 20
FEWEST = 4
SAME_M, SAME_RAD = 0.06, float(np.radians(5.0))


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """A view thinned to a grain, with what each place looks like: points (N, 3), normals (N, 3), features (N, 33)."""

    grain_m: float
    points_m: F64
    normals: F64
    features: F32


def shape(patches: Patches, grain_m: float) -> Shape:
    """Describe a view; views to be compared need the same grain."""
    import open3d as o3d

    if len(patches.points_m) < FEWEST:
        return Shape(grain_m, np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 33), np.float32))
    cloud = o3d.geometry.PointCloud()
    cloud.points = o3d.utility.Vector3dVector(patches.points_m)
    cloud.normals = o3d.utility.Vector3dVector(patches.normals)
    thin = cloud.voxel_down_sample(grain_m)
    thin.normalize_normals()
    around = o3d.geometry.KDTreeSearchParamHybrid(5 * grain_m, 100)
    features = o3d.pipelines.registration.compute_fpfh_feature(thin, around)
    return Shape(
        grain_m, np.array(thin.points), np.array(thin.normals), np.asarray(features.data, dtype=np.float32).T.copy()
    )


def guesses(source: Shape, target: Shape) -> list[Pose]:
    """Return a few poses, source → target, the one that most places agree with first; none where too few do."""
    if min(len(source.points_m), len(target.points_m)) < FEWEST:
        return []
    i, j = _alike(source.features, target.features)
    if len(i) < 2 * FEWEST:
        return []
    p, q, m, n = source.points_m[i], target.points_m[j], source.normals[i], target.normals[j]
    consistent = _consistency(p, q, m, n, source.grain_m)
    found: list[tuple[int, Pose]] = []
    for seed in np.argsort(-consistent.sum(axis=1))[:SEEDS]:
        circle = np.argsort(-consistent[seed])[:CIRCLE]
        circle = np.append(circle[consistent[seed, circle] > 0], seed)
        if len(circle) > FEWEST:
            found.append(_agreed(p, q, m, n, circle, source.grain_m))
    found.sort(key=lambda entry: -entry[0])
    kept: list[Pose] = []
    for agreeing, pose in found:
        if agreeing >= FEWEST and len(kept) < MOST_GUESSES and all(differ(pose, other) for other in kept):
            kept.append(pose)
    return kept


def differ(one: Pose, other: Pose, most_m: float = SAME_M, most_rad: float = SAME_RAD) -> bool:
    """Tell whether two poses are two, judged a metre before the sensor."""
    moved, turned = one.distance_to(other, np.array([[0.0, 0.0, 1.0]]))
    return moved > most_m or turned > most_rad


def _alike(source: F32, target: F32) -> tuple[Ints, Ints]:
    """Return pairs of places that are each other's most alike, at most `MOST_ALIKE`, the most telling ones."""
    gap = (source**2).sum(axis=1)[:, None] + (target**2).sum(axis=1) - 2.0 * source @ target.T
    there, back = gap.argmin(axis=1), gap.argmin(axis=0)
    i = np.nonzero(back[there] == np.arange(len(there)))[0]
    if len(i) > MOST_ALIKE:
        best, second = np.partition(gap[i], 1, axis=1)[:, :2].T
        i = np.sort(i[np.argsort(best / np.maximum(second, 1e-6), kind="stable")[:MOST_ALIKE]])
    return i, there[i]


def _consistency(p: F64, q: F64, m: F64, n: F64, grain_m: float) -> F32:
    """Return (K, K) in how many others each two pairs agree, 0 where they contradict each other themselves."""
    near, far = _distances(p), _distances(q)
    kept = (np.abs(near - far) < grain_m) & (np.minimum(near, far) > 2 * grain_m) & (np.abs(m @ m.T - n @ n.T) < 0.35)
    first = kept.astype(np.float32)
    return np.asarray(first * (first @ first))


def _distances(points: F64) -> F32:
    square = (points**2).sum(axis=1)
    return np.asarray(np.sqrt(np.maximum(square[:, None] + square - 2.0 * points @ points.T, 0.0)), dtype=np.float32)


def _agreed(p: F64, q: F64, m: F64, n: F64, circle: Ints, grain_m: float) -> tuple[int, Pose]:
    """Return a pose from a few pairs, bettered by all that agree, and how many these are."""
    pose, agreeing = rigid(p[circle], q[circle]), 0
    for _ in range(2):
        close = np.linalg.norm(pose.apply(p) - q, axis=1) < 1.2 * grain_m
        close &= (pose.turn(m) * n).sum(axis=1) > 0.7
        agreeing = int(close.sum())
        if agreeing < FEWEST:
            break
        pose = rigid(p[close], q[close])
    return agreeing, pose


def rigid(source: F64, target: F64) -> Pose:
    """Return the pose that takes points (N, 3) to their partners with the least squares (Kabsch 1976)."""
    a, b = source.mean(axis=0), target.mean(axis=0)
    rotation = nearest_rotation((target - b).T @ (source - a))
    return Pose(rotation, b - rotation @ a)
