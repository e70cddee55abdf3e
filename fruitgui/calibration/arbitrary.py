"""Register two views of any scene, with no belt and no guess: the error study's own registration.

Features of shape (FPFH, Rusu 2009) give several first guesses by RANSAC; each is settled on
thinned clouds, and where enough of them meets, refined by point-to-plane ICP and judged by what
one view sees where the other looks through. Views whose guesses contradict each other, or that
meet over too little, are left out with a reason.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fruitgui.calibration.paper import point_to_point
from fruitgui.calibration.still import INVERSE_NOISE, INVERSE_STEP, Still
from fruitgui.geometry.pose import Pose

if TYPE_CHECKING:
    import open3d as o3d

VOXEL_M = 0.05
FINE_M, FINE_SHARE = 0.03, 0.012
"""Points are averaged over 12 mm for each metre of distance, 30 mm at most: finer grids gave the same poses (0.60° and
23 mm against 0.62° and 23 mm, 39 pairs of a kitchen) at twice the time."""
GUESSES = 2
FARTHEST_M = 3.5
LEAST_OVERLAP = 0.35
HOPELESS = 0.6 * LEAST_OVERLAP
"""A guess of which less meets once settled roughly is not refined: refining adds a few hundredths."""
MOST_THROUGH = 0.06
LEAST_INFORMATION = 0.004
SAME_M, SAME_RAD = 0.05, float(np.radians(4.0))


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """One view made ready: a cloud with normals for ICP, and a thinned one with features for guesses."""

    still: Still
    fine: o3d.geometry.PointCloud
    thin: o3d.geometry.PointCloud
    features: o3d.pipelines.registration.Feature


@dataclass(frozen=True, slots=True, eq=False)
class Match:
    """A registration of two views of any scene.

    Attributes:
        pose: source's optical frame → target's; None where it is left out.
        paper: what plain point-to-point ICP makes of the same first guess; None where left out.
        reason: why it is left out, or empty.
        overlap: share of the source that meets the target.
        starts: the first guesses.
    """

    pose: Pose | None
    paper: Pose | None
    reason: str
    overlap: float
    starts: tuple[Pose, ...]


def scan(still: Still) -> Scan:
    """Prepare one view."""
    import open3d as o3d

    stride = max(1, round(still.intrinsics.width / 320))
    points = still.points()[::stride, ::stride].reshape(-1, 3).astype(np.float64)
    points = points[(points[:, 2] > 0) & (points[:, 2] < FARTHEST_M)]
    cloud = o3d.geometry.PointCloud()
    cloud.points = o3d.utility.Vector3dVector(points)
    fine = cloud.voxel_down_sample(min(FINE_M, FINE_SHARE * float(np.median(points[:, 2]))))
    fine.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(0.07, 30))
    fine.orient_normals_towards_camera_location(np.zeros(3))
    thin = cloud.voxel_down_sample(VOXEL_M)
    thin.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(2 * VOXEL_M, 30))
    thin.orient_normals_towards_camera_location(np.zeros(3))
    features = o3d.pipelines.registration.compute_fpfh_feature(
        thin, o3d.geometry.KDTreeSearchParamHybrid(5 * VOXEL_M, 100)
    )
    return Scan(still, fine, thin, features)


def register_any(source: Scan, target: Scan, seed: int = 0, known: Match | None = None) -> Match:
    """Find the pose of the source in the target's frame with no guess, or say why it cannot be trusted.

    `known` is the match of the reverse pair, if there is one: its first guesses, turned round, serve again.
    """
    starts = _guesses(source, target, seed) if known is None else [start.inverse() for start in known.starts]
    settled = [(start, pose) for start in starts if (pose := settle(source, target, start)) is not None]
    found = [
        (_judged(source.fine, target, refined), start, refined)
        for start, pose in settled
        if (refined := refine_any(source, target, pose)) is not None
    ]
    if not found:
        return Match(None, None, f"too little overlap: no first guess lets {HOPELESS:.0%} meet", 0.0, tuple(starts))
    found.sort(key=lambda entry: -entry[0][0] + 4 * entry[0][1])
    (overlap, through, information), start, pose = found[0]
    why = _doubt(overlap, through, information)
    if not why:
        others = [(one[0] - 4 * one[1], other) for one, _, other in found[1:]]
        if any(score > 0.85 * (overlap - 4 * through) and _differs(pose, other) for score, other in others):
            why = "ambiguous: two different poses fit about as well"
    if why:
        return Match(None, None, why, overlap, tuple(starts))
    paper = point_to_point(np.asarray(source.fine.points), np.asarray(target.fine.points), start, reach_m=0.05)
    return Match(pose, paper, "", overlap, tuple(starts))


def _doubt(overlap: float, through: float, information: float) -> str:
    if overlap < LEAST_OVERLAP:
        return f"too little overlap: {overlap:.0%} of the source meets the target"
    if through > MOST_THROUGH:
        return f"contradicted: the target looks through {through:.0%} of the source"
    if information < LEAST_INFORMATION:
        return "too little structure: surfaces could slide on each other"
    return ""


def _differs(one: Pose, other: Pose) -> bool:
    moved, turned = one.distance_to(other, np.array([[0.0, 0.0, 1.5]]))
    return moved > SAME_M or turned > SAME_RAD


def _guesses(source: Scan, target: Scan, seed: int) -> list[Pose]:
    import open3d as o3d

    registration = o3d.pipelines.registration
    guesses: list[Pose] = []
    for k in range(GUESSES):
        o3d.utility.random.seed(1000 * seed + k)
        with o3d.utility.VerbosityContextManager(o3d.utility.VerbosityLevel.Error):  # its warnings go to our output
            found = registration.registration_ransac_based_on_feature_matching(
                source.thin,
                target.thin,
                source.features,
                target.features,
                mutual_filter=True,
                max_correspondence_distance=1.5 * VOXEL_M,
                estimation_method=registration.TransformationEstimationPointToPoint(False),
                ransac_n=3,
                checkers=[
                    registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
                    registration.CorrespondenceCheckerBasedOnDistance(1.5 * VOXEL_M),
                ],
                criteria=registration.RANSACConvergenceCriteria(8_000, 0.999),
            )
        matrix = np.asarray(found.transformation)
        pose = Pose(matrix[:3, :3].copy(), matrix[:3, 3].copy())
        if found.fitness > 0 and not any(not _differs(pose, other) for other in guesses):
            guesses.append(pose)
    return guesses


def settle(source: Scan, target: Scan, start: Pose) -> Pose | None:
    """Settle a first guess on the thinned clouds; None where too little of them meets for more to be worth it."""
    pose = _aligned(source.thin, target.thin, start, reach_m=2.5 * VOXEL_M, scale_m=0.03)
    return None if pose is None or _judged(source.thin, target, pose)[0] < HOPELESS else pose


def refine_any(source: Scan, target: Scan, start: Pose) -> Pose | None:
    """Refine a pose by point-to-plane ICP with a robust kernel, noise growing with z² weighed in by the kernel."""
    near = _aligned(source.fine, target.fine, start, reach_m=0.06, scale_m=0.015)
    return None if near is None else _aligned(source.fine, target.fine, near, reach_m=0.03, scale_m=0.008)


def _aligned(
    source: o3d.geometry.PointCloud, target: o3d.geometry.PointCloud, start: Pose, *, reach_m: float, scale_m: float
) -> Pose | None:
    """Return where robust point-to-plane ICP (Tukey, cut at three times the scale) comes to rest; None if lost."""
    import open3d as o3d

    registration = o3d.pipelines.registration
    found = registration.registration_icp(
        source,
        target,
        reach_m,
        start.matrix,
        registration.TransformationEstimationPointToPlane(registration.TukeyLoss(3 * scale_m)),
        registration.ICPConvergenceCriteria(max_iteration=30),
    )
    if found.fitness < 0.05:
        return None
    matrix = np.asarray(found.transformation)
    return Pose(matrix[:3, :3].copy(), matrix[:3, 3].copy())


def _judged(source: o3d.geometry.PointCloud, target: Scan, pose: Pose) -> tuple[float, float, float]:
    """Return the share of the source that meets the target, the share that it looks through, and the least of the
    normals' spread (how well the weakest direction is held)."""
    local = pose.apply(np.asarray(source.points))
    camera = target.still.intrinsics
    ahead = local[:, 2] > 0.3
    u, v = np.round(np.clip(camera.project(np.where(ahead[:, None], local, 1.0)), -1, 1e5)).astype(int).T
    inside = ahead & (u >= 0) & (v >= 0) & (u < camera.width) & (v < camera.height)
    q = np.where(inside, target.still.inverse_depth[np.where(inside, v, 0), np.where(inside, u, 0)], 0.0)
    known = q > 0
    gap = q - 1.0 / np.where(ahead, local[:, 2], 1.0)
    bound = 4 * (INVERSE_STEP + INVERSE_NOISE)
    met = known & (np.abs(gap) < bound)
    through = known & (gap < -3 * bound)
    normals = pose.turn(np.asarray(source.normals))[met]
    information = float(np.linalg.eigvalsh(normals.T @ normals / max(len(normals), 1))[0]) if met.any() else 0.0
    return float(met.mean()), float(through.sum() / max(known.sum(), 1)), information
