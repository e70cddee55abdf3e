from __future__ import annotations

import numpy as np
import pytest

from fruitgui.frame import Frame
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.fused_cloud import fused_clouds
from fruitgui.station.station import Station, StationSensor


@pytest.fixture(scope="module")
def scene() -> tuple[dict[str, list[Frame]], Station]:
    simulation = still_scene(5, "opposed", 12, captures=2)
    stills: dict[str, list[Frame]] = {}
    for frame in simulation.frames():
        stills.setdefault(frame.sensor, []).append(frame)
    mounts = simulation.rig().mounts
    sensors = {name: StationSensor("", mount.pose, mount.surface) for name, mount in mounts.items()}
    return stills, Station("kinect_1", sensors)


def _apart_m(first: np.ndarray, second: np.ndarray) -> float:
    """Return how far, at the median, tops of one cloud are from the nearest tops of the other."""
    from scipy.spatial import cKDTree

    tops, others = (cloud[cloud[:, 2] > 0.02] for cloud in (first, second))
    return float(np.median(cKDTree(others).query(tops)[0]))


def test_what_true_poses_lay_together_lies_together_and_before_it_did_not(
    scene: tuple[dict[str, list[Frame]], Station],
) -> None:
    stills, station = scene
    one, other = fused_clouds(stills, None, station)
    assert _apart_m(one.after_m, other.after_m) < 0.006
    assert _apart_m(one.before_m, other.before_m) > 0.012
    for cloud in (one, other):
        assert len(cloud.before_m) == len(cloud.after_m) == len(cloud.colors)
        belt = cloud.after_m[np.abs(cloud.after_m[:, 2]) < 0.01]
        assert len(belt) > 0.4 * len(cloud.after_m), "most of what is seen is the belt, and the belt is z = 0"


def test_a_refusal_shows_what_was_before(scene: tuple[dict[str, list[Frame]], Station]) -> None:
    stills, _ = scene
    for cloud in fused_clouds(stills, None, None):
        assert np.array_equal(cloud.before_m, cloud.after_m)


def test_the_longer_side_lies_along_x(scene: tuple[dict[str, list[Frame]], Station]) -> None:
    stills, station = scene
    together = np.concatenate([cloud.after_m for cloud in fused_clouds(stills, station, station)])
    assert np.ptp(together[:, 0]) > np.ptp(together[:, 1])
