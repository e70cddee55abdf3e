"""Perception on frames of real sensors; figures are printed (pytest -s)."""

# ruff: noqa: T201 (figures are printed, pytest -s)
from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from fruitgui.frame import U8, Bools, Frame, Intrinsics
from fruitgui.geometry.plane import Plane, Surface, fit_plane
from fruitgui.perception import FEATURE_NAMES, Perceiver, PerceptionSettings
from fruitgui.perception.colour import COLOUR_NAMES
from fruitgui.perception.view import FruitView
from tests.real_data import real_data

pytestmark = [pytest.mark.accuracy, pytest.mark.real]

KINECT = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
TABLEWARE = PerceptionSettings(smallest_m=0.04, largest_m=0.40, tallest_m=0.30)


def robust_plane(frame: Frame, where: Bools | None = None, tolerance_m: float = 0.006) -> Plane:
    """Return the plane that most points lie on (RANSAC, then least squares on those)."""
    points = frame.points()[::4, ::4].reshape(-1, 3).astype(float)
    points = points[(points[:, 2] > 0) & (where[::4, ::4].reshape(-1) if where is not None else True)]
    rng = np.random.default_rng(0)
    planes = [fit_plane(points[rng.choice(len(points), 3, replace=False)]) for _ in range(150)]
    best = max(planes, key=lambda plane: int((np.abs(plane.height_m(points)) < tolerance_m).sum()))
    for _ in range(4):
        best = fit_plane(points[np.abs(best.height_m(points)) < tolerance_m])
    return best.facing(np.zeros(3))


def filled(view: FruitView) -> Bools:
    mask = np.zeros((480, 640), np.uint8)
    cv2.drawContours(mask, [np.rint(view.outline_px).astype(np.int32)], 0, 1, cv2.FILLED)
    return mask > 0


def picture(path: Path) -> U8:
    return np.ascontiguousarray(cv2.imread(str(path))[..., ::-1])


def test_things_on_a_table_are_counted_and_outlined() -> None:
    """Bowls, cups, boxes, seen by a Kinect v1. Where one stands on another, a flat surface holds one thing only."""
    folder = real_data("kinect_table")
    right, best, scenes = 0, [], 0
    for path in sorted(folder.glob("*_color.png")):
        name = path.name.removesuffix("_color.png")
        depth = cv2.imread(str(folder / f"{name}_depth.png"), cv2.IMREAD_UNCHANGED)
        labels = cv2.imread(str(folder / f"{name}_label.png"), cv2.IMREAD_UNCHANGED).astype(int)
        frame = Frame("table", 0, 0.0, picture(path), depth, KINECT)
        found = Perceiver("table", KINECT, Surface(robust_plane(frame)), TABLEWARE).observe(frame, 0.0).views
        things = np.where(labels >= 20, labels // 10, 0)
        ids = [thing for thing in np.unique(things) if thing]
        masks = [filled(view) for view in found]
        overlaps = [max((m & (things == i)).sum() / (m | (things == i)).sum() for m in masks) for i in ids]
        scenes, right = scenes + 1, right + (len(found) == len(ids))
        best += overlaps
        print(f"{name}: {len(ids)} things, {len(found)} seen, IoU {' '.join(f'{iou:.2f}' for iou in overlaps)}")
    print(f"count right in {right} of {scenes} scenes, median IoU {np.median(best):.3f}")
    assert right >= scenes - 3
    assert np.median(best) > 0.93


def test_clutter_seen_from_above_is_found() -> None:
    folder = real_data("overhead")
    board = np.zeros((480, 640), bool)
    board[80:350, 60:600] = True
    for number in range(3):
        depth = cv2.imread(str(folder / f"clutter_depth_{number}.png"), cv2.IMREAD_UNCHANGED)
        truth = cv2.imread(str(folder / f"clutter_segmask_{number}.png"), cv2.IMREAD_UNCHANGED) > 0
        frame = Frame("top", 0, 0.0, picture(folder / f"clutter_color_{number}.png"), depth, KINECT)
        plane = robust_plane(frame, board & ~truth)
        corners = np.array([[60, 80], [600, 80], [600, 350], [60, 350]])
        rays = np.hstack([KINECT.rays()[corners[:, 1] - 1, corners[:, 0] - 1].astype(float), np.ones((4, 1))])
        region = rays * (-plane.offset_m / (rays @ plane.normal))[:, None]
        found = Perceiver("top", KINECT, Surface(plane, region)).observe(frame, 0.0).views
        seen = np.any([filled(view) for view in found], axis=0)
        recall, precision = (seen & truth).sum() / truth.sum(), (seen & truth).sum() / seen.sum()
        print(f"clutter {number}: {len(found)} views, recall {recall:.2f}, precision {precision:.2f}")
        # Masks are drawn on the colour picture; depth widens edges by two pixels, and thin tools are left out.
        assert recall > 0.8
        assert precision > 0.65


def test_a_real_banana_is_one_and_as_high_as_it_is() -> None:
    folder = real_data("banana_xtion")
    values = json.loads((folder / "camera.json").read_text())["rig"]["camera"][0]["camera_model"]["params"]
    camera = Intrinsics(640, 480, *values[:4])
    depth = cv2.imread(str(folder / "000001-depth.png"), cv2.IMREAD_UNCHANGED)
    frame = Frame("desk", 0, 0.0, picture(folder / "000001-color.png"), np.rint(depth / 10.0).astype(np.uint16), camera)
    table = np.zeros((480, 640), bool)
    table[300:] = True
    plane = robust_plane(frame, table, 0.005)
    found = Perceiver("desk", camera, Surface(plane), TABLEWARE).observe(frame, 0.0).views
    banana = min(found, key=lambda view: abs(view.box_px[0] - 140) + abs(view.box_px[1] - 350))
    print(f"banana: {banana.height_m * 1e3:.1f} mm high (36.3), {len(banana.points_m)} points")
    assert banana.height_m == pytest.approx(0.0363, abs=0.003)
    assert banana.whole
    assert not banana.shared


def test_the_half_surface_of_a_real_banana_makes_a_volume_and_an_outline() -> None:
    from fruitgui.perception.outline import fit_ellipses, joined
    from fruitgui.perception.paper import paper_volume_m3

    rows = np.loadtxt(real_data("fruit_cloud/banana_1_1_1.pcd"), skiprows=10, usecols=(0, 1, 2, 4, 5))
    optical = rows[:, [0, 2, 1]] * [1.0, -1.0, 1.0]
    optical = optical[np.isfinite(optical).all(axis=1) & (optical[:, 2] > 0)]
    volume_ml = paper_volume_m3(optical.astype(np.float32)) * 1e6
    mask = np.zeros((480, 640), np.uint8)
    mask[rows[:, 4].astype(int) % 480, rows[:, 3].astype(int) % 640] = 255
    mask = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    ellipse = fit_ellipses(joined((max(contours, key=cv2.contourArea),)))
    print(f"banana cloud: hull with its mirror image {volume_ml:.0f} ml, axes {ellipse.axes_px[0].round(0)} px")
    # A banana with its skin holds 100–250 ml; the hull of a bent one holds more.
    assert 80 < volume_ml < 700
    assert 1.2 < ellipse.axes_px[0, 0] / ellipse.axes_px[0, 1] < 8.0


def test_colours_tell_kinds_apart_in_shop_photos() -> None:
    """Leave one photo out, nearest of the others by the colour features that light does not move."""
    folder = real_data("photos")
    rows, kinds = [], []
    for path in sorted(folder.rglob("*.*g")):
        rows.append(photo_features(picture(path)))
        kinds.append(path.parent.name)
    table = np.array(rows)
    table = (table - table.mean(axis=0)) / np.maximum(table.std(axis=0), 1e-6)
    apart = np.linalg.norm(table[:, None] - table[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    right = np.mean([kinds[near] == kind for near, kind in zip(apart.argmin(axis=1), kinds, strict=True)])
    print(f"photos: {len(kinds)} of {len(set(kinds))} kinds, nearest other photo is of the same kind: {right:.0%}")
    assert right > 3.0 / len(set(kinds))


def photo_features(color: U8) -> np.ndarray:
    """Return the chroma features of the middle of a photo."""
    from fruitgui.perception.colour import BeltColour, calm_picture, colour_features
    from fruitgui.perception.limits import depth_limits
    from fruitgui.perception.parts import Parts
    from fruitgui.perception.pixels import gather_pixels

    color = cv2.resize(color, (320, 240))
    camera = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
    limits = depth_limits(camera, Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0)), PerceptionSettings())
    middle = np.zeros((240, 320), np.uint8)
    middle[60:180, 80:240] = 1
    parts = Parts(middle, (), ((80, 60, 160, 120),), np.zeros(1, np.intp), np.zeros(1, bool))
    pixels = gather_pixels(parts, np.full((240, 320), 950, np.uint16), limits)
    features = colour_features(pixels, calm_picture(color, limits), BeltColour(0.0, 0.0, 0.0))[0]
    return features[[n for n, name in enumerate(COLOUR_NAMES) if name.startswith("chroma_") and "belt" not in name]]


BARE_TABLE = 15
"""The frame of the rolling apples whose plane is the table's: later bag, books and apples cover it."""


def test_rolling_apples_are_seen_at_the_size_of_apples() -> None:
    """A person tips nine or ten apples onto a table beside a laptop, a box and books; frames 27–37 have them apart.

    They are motion-blurred, and colour and depth of this recording are not of one moment. Things that are no fruit
    stand around them: only round views of an apple's height are counted.
    """
    from fruitgui.sensors.recordings import open_recording

    recording = open_recording(real_data("apples_rolling.mcap"))
    perceiver = None
    counts, diameters = [], []
    for number, (_, frame) in enumerate(recording.frames()):
        if number < BARE_TABLE:
            continue
        if perceiver is None:
            surface = Surface(robust_plane(frame, tolerance_m=0.008))
            perceiver = Perceiver(frame.sensor, frame.intrinsics, surface)
        if number < 26:
            continue
        apples = [v for v in perceiver.observe(frame, frame.time_s).views if 0.04 < v.height_m < 0.11]
        counts.append(len(apples))
        diameters += [round_diameter_m(v) for v in apples if v.whole and not v.shared and looks_round(v)]
    print(f"apples: {counts} seen, diameters of {len(diameters)} lone ones: median {np.median(diameters) * 1e3:.0f} mm")
    assert np.median(counts) >= 6
    assert len(diameters) >= 8
    assert 0.055 < np.median(diameters) < 0.095


def feature(view: FruitView, name: str) -> float:
    return float(view.features[FEATURE_NAMES.index(name)])


def looks_round(view: FruitView) -> bool:
    return feature(view, "shape_width_to_length") > 0.75 and feature(view, "shape_solidity") > 0.93


def round_diameter_m(view: FruitView) -> float:
    """Return the diameter of the circle with the silhouette's area."""
    return float(np.exp(feature(view, "size_root_area")) * 2.0 / np.sqrt(np.pi))
