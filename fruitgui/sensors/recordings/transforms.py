"""The tree of static transforms: where one camera is from another."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

import numpy as np

from fruitgui.geometry.pose import Pose
from fruitgui.sensors.recordings.wire import Transform


def find_pose(transforms: Iterable[Transform], *, source: str, target: str) -> Pose | None:
    """Return the pose that maps points of frame `source` into frame `target`; None where no chain links them.

    Where an edge is given more than once the last counts, as in tf2. Edges that
    are not rigid transforms (not finite, no rotation) are left out.
    """
    if source == target:
        return Pose()
    edges = {(edge.parent, edge.child): pose for edge in transforms if (pose := _rigid(edge)) is not None}
    steps: dict[str, list[tuple[str, Pose]]] = {}
    for (parent, child), to_parent in edges.items():
        steps.setdefault(child, []).append((parent, to_parent))
        steps.setdefault(parent, []).append((child, to_parent.inverse()))
    reached = {source: Pose()}
    waiting = deque([source])
    while waiting and target not in reached:
        frame = waiting.popleft()
        for neighbour, step in steps.get(frame, ()):
            if neighbour not in reached:
                reached[neighbour] = step @ reached[frame]
                waiting.append(neighbour)
    return reached.get(target)


def _rigid(edge: Transform) -> Pose | None:
    quaternion = np.array(edge.quaternion_xyzw)
    length = float(np.linalg.norm(quaternion))
    if not (np.isfinite(edge.translation_m).all() and 0.5 < length < 2.0):
        return None
    x, y, z, w = quaternion / length
    rotation = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    return Pose(rotation, np.array(edge.translation_m))
