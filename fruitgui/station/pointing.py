"""Finding the fruit that a person pointed at: from a point in a picture to a track."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import FruitView
from fruitgui.station.labels import Label
from fruitgui.station.observing import Seen
from fruitgui.tracking.track import Track

NEAREST_FRAME_S = 0.05
"""A label's time names a frame; one farther off than this is another."""

OUTSIDE_PX = 6.0
"""How far outside of an outline a finger may point and still mean that fruit."""

SAME_PLACE_M = 0.04
"""A track that was farther from the view's centre at that time is another fruit."""


@dataclass(frozen=True, slots=True, eq=False)
class Pointed:
    """Where the fruit of one label was.

    Attributes:
        label: the row.
        view: that it points at.
        time_s: of the view's frame, reference clock.
        centre_m: (3,) of the view, reference frame.
    """

    label: Label
    view: FruitView
    time_s: float
    centre_m: F64


class Pointer:
    """Watches observations pass and remembers which view each label points at."""

    def __init__(self, labels: Iterable[Label], rig: Rig) -> None:
        self._rig = rig
        self._by_sensor: dict[str, list[Label]] = defaultdict(list)
        for label in sorted(labels, key=lambda one: one.time_s):
            self._by_sensor[label.sensor].append(label)
        self._times = {name: np.array([one.time_s for one in rows]) for name, rows in self._by_sensor.items()}
        self._found: dict[int, tuple[float, Pointed | None]] = {}

    def look(self, seen: Seen) -> None:
        """Take note of a frame; the nearest one to each label's time decides."""
        sensor = seen.recorded_as if seen.recorded_as in self._by_sensor else seen.observation.sensor
        if sensor not in self._by_sensor:
            return
        times, labels = self._times[sensor], self._by_sensor[sensor]
        first, last = np.searchsorted(times, [seen.frame_time_s - NEAREST_FRAME_S, seen.frame_time_s + NEAREST_FRAME_S])
        for label in labels[first:last]:
            apart_s = abs(label.time_s - seen.frame_time_s)
            if apart_s < self._found.get(label.line, (np.inf, None))[0]:
                self._found[label.line] = (apart_s, self._pointed(label, seen))

    def _pointed(self, label: Label, seen: Seen) -> Pointed | None:
        observation = seen.observation
        inside = [(_inside_px(label, view), view) for view in observation.views]
        best = max(inside, key=lambda one: one[0], default=None)
        if best is None or best[0] < -OUTSIDE_PX:
            return None
        view = best[1]
        centre_m = self._rig.mounts[observation.sensor].pose.apply(view.centre_m)
        return Pointed(label, view, observation.time_s, centre_m)

    def pointed(self) -> list[Pointed]:
        """Return the labels that point at a view."""
        return [found for _, found in self._found.values() if found is not None]

    def missed(self) -> list[tuple[Label, str]]:
        """Return the labels that point at none, with why."""
        missed = []
        for labels in self._by_sensor.values():
            for label in labels:
                _, found = self._found.get(label.line, (np.inf, None))
                if label.line not in self._found:
                    missed.append((label, f"no frame of sensor {label.sensor} at {label.time_s:.3f} s"))
                elif found is None:
                    missed.append((label, f"no fruit at ({label.u_px:.0f}, {label.v_px:.0f}) in that frame"))
        return sorted(missed, key=lambda one: one[0].line)


def _inside_px(label: Label, view: FruitView) -> float:
    outline = np.ascontiguousarray(view.outline_px.reshape(-1, 1, 2), dtype=np.float32)
    return float(cv2.pointPolygonTest(outline, (label.u_px, label.v_px), True))


def assign(pointed: Sequence[Pointed], tracks: Sequence[Track]) -> Mapping[int, list[Label]]:
    """Return the labels of each track, by its index: the track that was where the view was, when it was seen."""
    labels: dict[int, list[Label]] = defaultdict(list)
    for one in pointed:
        distances = [_distance_m(one, track) for track in tracks]
        if distances and min(distances) <= SAME_PLACE_M:
            labels[int(np.argmin(distances))].append(one.label)
    return labels


def _distance_m(pointed: Pointed, track: Track) -> float:
    """Return how far a track was from a pointed place at that time; zero where it holds that very view."""
    times = np.array([point.time_s for point in track.path])
    if not times[0] - 1.0 <= pointed.time_s <= times[-1] + 1.0:
        return float("inf")
    if any(sighting.view is pointed.view for sighting in track.sightings):
        return 0.0
    nearest = track.path[int(np.argmin(np.abs(times - pointed.time_s)))]
    carried_m = nearest.position_m + track.velocity_m_s * (pointed.time_s - nearest.time_s)
    return float(np.linalg.norm(carried_m - pointed.centre_m))
