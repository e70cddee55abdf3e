"""Half a banana as a real sensor saw it: a plausible size, and a standard deviation that says how little was seen."""

from __future__ import annotations

import sys

import cv2
import numpy as np
import pytest

from fruitgui.frame import Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.measurement.size import measure
from fruitgui.perception.view import FruitView
from fruitgui.tracking.track import PathPoint, Sighting, Track
from tests.real_data import real_data

pytestmark = [pytest.mark.accuracy, pytest.mark.real]

CAMERA = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)


def test_half_a_banana_is_a_banana_and_unsure() -> None:
    lines = real_data("fruit_cloud/banana_1_1_1.pcd").read_text(encoding="ascii").splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith("DATA")) + 1
    cloud = np.array([[float(value) for value in line.split()] for line in lines[start:] if line.strip()])
    cloud = cloud[np.isfinite(cloud).all(axis=1)]
    # the file's y is depth and its z is up; the optical frame's y is down and its z is depth
    points = np.column_stack([cloud[:, 0], -cloud[:, 2], cloud[:, 1]])
    # the publishers' first camera looks 30° down on the table
    up = np.array([0.0, -np.cos(np.deg2rad(30.0)), -np.sin(np.deg2rad(30.0))])
    table = Plane(up, -float(np.percentile(points @ up, 0.5)))
    mean = points.mean(axis=0)
    pixel = cloud[:, 4:6].astype(int)
    mask = np.zeros((480, 640), np.uint8)
    mask[pixel[:, 1], pixel[:, 0]] = 1
    mask = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    edge = cv2.distanceTransform(mask, cv2.DIST_L2, 3)[pixel[:, 1], pixel[:, 0]]
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    outline = max(contours, key=len)[:, 0].astype(np.float32)
    view = FruitView(
        "xtion", 0, 0.0, (0, 0, 10, 10), outline, points.astype(np.float32), edge.astype(np.float32),
        len(points), mean + np.array([0.0, 0.0, 0.01]), 1e-4 * np.eye(3), mean, 1e-5 * np.eye(3),
        float(np.percentile(table.height_m(points), 97)),
        np.zeros(1, np.float32), np.zeros((40, 40, 3), np.uint8), True, False, np.ones(len(outline), bool),
    )  # fmt: skip
    surface = Surface(table)
    rig = Rig("xtion", {"xtion": Mount("xtion", Pose.exact(), surface, CAMERA)})
    path = (PathPoint(0.0, view.centre_m, 1e-4 * np.eye(3)),)
    size = measure(Track(1, (Sighting(0.0, view),), path, np.array([0.1, 0.0, 0.0])), rig)
    sys.stdout.write(
        f"\nbanana, one view: {size.volume_m3.value * 1e6:.0f} ± {size.volume_m3.std * 1e6:.0f} ml, length "
        f"{size.length_m.value * 1e3:.0f} ± {size.length_m.std * 1e3:.0f} mm, diameter "
        f"{size.diameter_m.value * 1e3:.0f} ± {size.diameter_m.std * 1e3:.0f} mm, seen {size.coverage:.0%}\n"
    )
    # bananas are 80–250 ml and 120–230 mm
    assert 60e-6 < size.volume_m3.value < 300e-6
    assert 0.8 * np.ptp(points, axis=0).max() < size.length_m.value < 0.30
    assert size.volume_m3.std > 0.05 * size.volume_m3.value
    assert size.coverage < 0.6
