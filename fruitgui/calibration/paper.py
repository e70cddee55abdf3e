"""The source's own method, as a baseline: plain point-to-point ICP (Besl & McKay 1992) and composition of pairs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from fruitgui.calibration.flat import Shift
from fruitgui.calibration.graph import Solution
from fruitgui.calibration.still import Still
from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose

if TYPE_CHECKING:
    from fruitgui.calibration.pair import Registration
    from fruitgui.calibration.relief import Relief

REACH_M = 0.02
ITERATIONS = 60
POINTS = 12_000


def point_to_point(source_m: F64, target_m: F64, start: Pose, reach_m: float = REACH_M) -> Pose:
    """Return the pose that plain ICP finds from a start, point clouds (N, 3) and (M, 3) in metres."""
    import open3d as o3d

    clouds = []
    for points in (source_m, target_m):
        cloud = o3d.geometry.PointCloud()
        cloud.points = o3d.utility.Vector3dVector(points)
        clouds.append(cloud)
    found = o3d.pipelines.registration.registration_icp(
        clouds[0],
        clouds[1],
        reach_m,
        start.matrix,
        o3d.pipelines.registration.TransformationEstimationPointToPoint(),
        o3d.pipelines.registration.ICPConvergenceCriteria(max_iteration=ITERATIONS),
    )
    matrix = np.asarray(found.transformation)
    return Pose(matrix[:3, :3].copy(), matrix[:3, 3].copy())


def cloud(still: Still, most: int = POINTS) -> F64:
    """Return at most about `most` points of a picture, nearer than 3 m, evenly spread over its pixels: (N, 3)."""
    stride = max(1, round((still.intrinsics.width * still.intrinsics.height / most) ** 0.5))
    points = still.points()[::stride, ::stride].reshape(-1, 3).astype(np.float64)
    return np.asarray(points[(points[:, 2] > 0) & (points[:, 2] < 3.0)])


def paper_poses(
    reference: str, reliefs: Mapping[str, Relief], solution: Solution, tried: Sequence[Registration]
) -> dict[str, Pose]:
    """Return every sensor's pose by plain ICP of neighbours and composition along the paths (equations 1 and 2)."""
    starts = _starts(tried)
    clouds = {sensor: cloud(relief.still) for sensor, relief in reliefs.items()}
    steps: dict[tuple[str, str], Pose] = {}
    poses = {reference: Pose()}
    for sensor, path in solution.paths.items():
        pose = Pose()
        for here, there in pairwise(path):
            if (here, there) not in steps:
                start = reliefs[there].frame.inverse() @ starts[here, there].pose() @ reliefs[here].frame
                steps[here, there] = point_to_point(clouds[here], clouds[there], start)
            pose = steps[here, there] @ pose
        poses[sensor] = pose
    return poses


def _starts(tried: Sequence[Registration]) -> dict[tuple[str, str], Shift]:
    starts: dict[tuple[str, str], Shift] = {}
    for pair in tried:
        if pair.start is not None:
            starts[pair.source, pair.target] = pair.start
            starts[pair.target, pair.source] = pair.start.inverse()
    return starts
