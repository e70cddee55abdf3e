"""`python -m fruitgui.evaluation.picture R.mcap --station S.json --report OUT.json --picture P.png`: what a run saw.

Every sensor's frame nearest to one moment, with the outlines that were seen in
it and, where a reported fruit was, its number, kind, volume and the ellipse in
which its centre lies with 95 % probability (the source's figure 16).
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from fruitgui.files import read_json
from fruitgui.frame import F64, U8, Frame
from fruitgui.geometry.rig import Mount
from fruitgui.perception.perceiver import Perceiver
from fruitgui.sensors.recordings import open_recording
from fruitgui.station.station_file import read_station

COLORS = ((86, 180, 233), (230, 159, 0), (0, 158, 115), (240, 228, 66), (0, 114, 178), (213, 94, 0), (204, 121, 167))
"""Okabe & Ito (2008): told apart by the colour-blind too."""

GREY = (200, 200, 200)
ELLIPSE_95 = 5.99
"""χ² with two degrees of freedom, 95 %."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw the picture that the arguments ask for."""
    parser = argparse.ArgumentParser(prog="python -m fruitgui.evaluation.picture", description=__doc__)
    parser.add_argument("recording", type=Path)
    for name in ("station", "report", "picture"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    options = parser.parse_args(arguments)
    report = read_json(options.report)
    picture = draw_run(options.recording, options.station, report, busiest_s(report))
    cv2.imwrite(str(options.picture), cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
    return 0


def busiest_s(report: Mapping[str, Any]) -> float:
    """Return a moment at which most fruit are in view, reference clock."""
    spans = [(one["first_seen_s"], one["last_seen_s"]) for one in report["fruit"]]
    moments = [0.5 * (first + last) for first, last in spans]
    return max(moments, key=lambda t: sum(first <= t <= last for first, last in spans), default=0.0)


def draw_run(recording: Path, station_path: Path, report: Mapping[str, Any], time_s: float) -> U8:
    """Return the pictures of all sensors at one moment, side by side, (H, W, 3) RGB."""
    station = read_station(station_path)
    opened = open_recording(recording)
    rig = station.rig({name: info.intrinsics for name, info in opened.sensors.items()})
    nearest: dict[str, tuple[float, Frame]] = {}
    for at_s, frame in opened.frames():
        if frame.sensor in rig.mounts and abs(at_s - time_s) < abs(nearest.get(frame.sensor, (1e9,))[0] - time_s):
            nearest[frame.sensor] = (at_s, frame)
    kinds = sorted(report["counts"])
    drawn = [_draw(frame, rig.mounts[name], report, at_s, kinds) for name, (at_s, frame) in sorted(nearest.items())]
    return np.concatenate(drawn, axis=1)


def _draw(frame: Frame, mount: Mount, report: Mapping[str, Any], time_s: float, kinds: Sequence[str]) -> U8:
    perceiver = Perceiver(mount.sensor, mount.intrinsics, mount.surface)
    observation = perceiver.observe(replace(frame, sensor=mount.sensor), time_s)
    picture = frame.color.copy()
    outlines = [view.outline_px.astype(np.int32).reshape(-1, 1, 2) for view in observation.views]
    cv2.polylines(picture, outlines, isClosed=True, color=GREY, thickness=1, lineType=cv2.LINE_AA)
    for fruit in report["fruit"]:
        if fruit["first_seen_s"] <= time_s <= fruit["last_seen_s"]:
            _draw_fruit(picture, mount, fruit, time_s, COLORS[kinds.index(fruit["kind"]) % len(COLORS)])
    return picture


def _draw_fruit(
    picture: U8, mount: Mount, fruit: Mapping[str, Any], time_s: float, color: tuple[int, int, int]
) -> None:
    point = min(fruit["path"], key=lambda one: abs(one["time_s"] - time_s))
    to_sensor = mount.pose.inverse()
    centre_m = to_sensor.apply(np.array(point["position_m"]))
    if centre_m[2] <= 0:
        return
    spread = to_sensor.rotation @ np.array(point["covariance_m2"]) @ to_sensor.rotation.T
    u, v = mount.intrinsics.project(centre_m[None])[0]
    axes, angle_deg = _ellipse_px(mount, centre_m, spread)
    middle = (round(float(u)), round(float(v)))
    cv2.ellipse(picture, middle, axes, angle_deg, 0, 360, color, 2, cv2.LINE_AA)
    texts = (f"{fruit['id']} {fruit['kind']}", f"{fruit['volume_ml']:.0f} ± {1.96 * fruit['volume_std_ml']:.0f} ml")
    for row, text in enumerate(texts):
        place = (middle[0] - 34, middle[1] + 34 + 14 * row)
        plain = text.replace("±", "+-")
        cv2.putText(picture, plain, place, cv2.FONT_HERSHEY_SIMPLEX, 0.4, (0, 0, 0), 3, cv2.LINE_AA)
        cv2.putText(picture, plain, place, cv2.FONT_HERSHEY_SIMPLEX, 0.4, color, 1, cv2.LINE_AA)


def _ellipse_px(mount: Mount, centre_m: F64, spread_m2: F64) -> tuple[tuple[int, int], float]:
    """Return half axes, pixels, and angle, degrees, of the 95 % ellipse in the picture."""
    x, y, z = centre_m
    camera = mount.intrinsics
    J = np.array([[camera.fx / z, 0.0, -camera.fx * x / z**2], [0.0, camera.fy / z, -camera.fy * y / z**2]])
    values, vectors = np.linalg.eigh(J @ spread_m2 @ J.T * ELLIPSE_95)
    halves = np.sqrt(np.maximum(values, 1.0))
    angle_deg = float(np.degrees(np.arctan2(vectors[1, 1], vectors[0, 1])))
    return (max(2, round(float(halves[1]))), max(2, round(float(halves[0])))), angle_deg


if __name__ == "__main__":
    sys.exit(main())
