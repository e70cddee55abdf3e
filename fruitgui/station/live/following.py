"""The middle of the line: observations in order in, fruit that left out, and what is in view to be drawn."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np

from fruitgui.frame import F32, F64, Frame, Intrinsics
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.perception.view import FruitView, Observation
from fruitgui.sensors.feed import Arrival
from fruitgui.station.live.above import NEAREST_M, FromAbove, pictured_spreads
from fruitgui.station.live.bench import Bench
from fruitgui.station.live.bump import BumpWatch
from fruitgui.station.live.crops import Album, Cut
from fruitgui.station.live.opinions import Opinions
from fruitgui.station.live.state import Pictured, Preview, Spread, TrackNow
from fruitgui.station.prelude import known_belt
from fruitgui.station.station import Station
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import LiveTrack, Tracker

TRAIL_STEP_M = 0.015
TRAIL_LENGTH = 64
"""A trail has a point every so far, and the last so many: a metre of way."""

LEAST_POINTS, OUTLINED_POINTS = 3, 96
"""An outline on the belt is that of so many points at least, and needs no more than so many."""

TELLING_FRUIT = 3

NOWHERE_PX: F32 = np.zeros((0, 2), dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Parted:
    """A fruit that has left: its track, and the cuts of it, the best first."""

    track: Track
    cuts: tuple[Cut, ...]


class _Trail:
    """Where one fruit was, and what was seen of it last; reference frame."""

    def __init__(self) -> None:
        self.places_m: deque[F64] = deque(maxlen=TRAIL_LENGTH)
        self._view: FruitView | None = None
        self._seen_at_m: F64 = np.zeros(3)
        self._outline_m: F64 = np.zeros((0, 3))

    def note(self, position_m: F64) -> None:
        """Add a place, if it is a step farther."""
        if not self.places_m or float(np.linalg.norm(position_m - self.places_m[-1])) >= TRAIL_STEP_M:
            self.places_m.append(position_m)

    def see(self, view: FruitView, position_m: F64) -> None:
        """Take what a sensor saw of it, when it was at a place."""
        self._view, self._seen_at_m = view, position_m

    def outline_m(self, mounts: Mapping[str, Mount], above: FromAbove, position_m: F64) -> F64:
        """Return the outline (K, 3) of what was seen, from above, carried along to where the fruit is now.

        It is made when it is drawn, which is less often than fruit are seen.
        """
        view, self._view = self._view, None
        if view is not None and len(view.points_m) >= LEAST_POINTS:
            every = max(len(view.points_m) // OUTLINED_POINTS, 1)
            points = mounts[view.sensor].pose.apply(view.points_m[::every])
            hull = cv2.convexHull(above.places_m(points).astype(np.float32), returnPoints=False)
            self._outline_m = points[hull[:, 0]] - self._seen_at_m
        return self._outline_m + position_m


class Following:
    """Follows fruit through the observations of one rig. Reads no feed and owns no thread.

    Args:
        rig: of the sensors that are there.
        station: that they belong to.
        bench: forms opinions on fruit in view.

    Attributes:
        velocity_m_s: (3,) of the belt, as fruit in view last showed it; None before.
    """

    def __init__(self, rig: Rig, station: Station, bench: Bench) -> None:
        self.rig = rig
        self._bumps = BumpWatch(rig)
        self._bench = bench
        self._known_belt = known_belt(station, None, None)
        self._tracker = Tracker(rig, self._known_belt)
        self.above = FromAbove(rig)
        self._to_sensor = {sensor: mount.pose.inverse() for sensor, mount in rig.mounts.items()}
        self._album = Album()
        self._opinions = Opinions(bench)
        self._trails: dict[int, _Trail] = {}
        self._live: tuple[LiveTrack, ...] = ()
        self._left: list[Track] = []
        self.velocity_m_s: F64 | None = station.velocity_m_s
        self.above.head_along(station.velocity_m_s)

    def follow(self, frame: Frame, observation: Observation, now_s: float) -> list[Parted]:
        """Take an observation and its frame; return the fruit that it finished."""
        self._bumps.see_frame(observation.sensor, frame)
        self._update(observation)
        for view, track in self._tracker.shown:
            self._album.look(track, view, frame)
        self._opinions.form(self._tracker, self._live, now_s)
        return self._parted()

    def begin_anew(self, cuts: Iterable[Cut]) -> None:
        """Forget all fruit in view; what was seen of them will come again.

        Args:
            cuts: of fruit that left and will leave again.
        """
        self._tracker = Tracker(self.rig, self._known_belt)
        self._opinions = Opinions(self._bench)
        self._trails, self._live, self._left = {}, (), []
        self._album.begin_anew(cuts)

    def follow_again(self, observation: Observation) -> list[Parted]:
        """Take an observation that was followed before, without its frame; return the fruit that it finished."""
        self._update(observation)
        for view, track in self._tracker.shown:
            self._album.find(track, view)
        return self._parted()

    def _update(self, observation: Observation) -> None:
        self._left += self._tracker.update(observation)
        self._live = self._tracker.live
        self._watch_belt()
        self._note()

    @property
    def stale(self) -> dict[tuple[str, ...], str]:
        """Which sensors were bumped, in words."""
        return self._bumps.close.stale

    def finish(self) -> list[Parted]:
        """Return the fruit still in view, as far as they count; nothing is in view afterwards."""
        self._left += self._tracker.finish()
        self._live = ()
        return self._parted()

    def _watch_belt(self) -> None:
        """Take the belt's velocity where enough fruit show it; one that is leaving, cut by an edge, does not."""
        belt, now = self._tracker.belt, self._tracker.belt_now
        if belt is not None and now is not None and len(self._tracker.shown) >= TELLING_FRUIT:
            self.velocity_m_s = now.velocity_m_s
            self.above.head_along(belt.velocity_m_s)

    def _note(self) -> None:
        """Write down where everything is."""
        places = {one.track: one.position_m for one in self._live}
        for gone in self._trails.keys() - places.keys():
            del self._trails[gone]
        for track, position_m in places.items():
            self._trails.setdefault(track, _Trail()).note(position_m)
        for view, track in self._tracker.shown:
            if track in places:
                self._trails[track].see(view, places[track])

    def see_off(self, parted: Parted) -> None:
        """Look at a fruit that left for good, for whether two sensors saw it at one place."""
        self._bumps.close.see_track(parted.track)

    def _parted(self) -> list[Parted]:
        """Return what left, with what left before an error kept it from being returned."""
        parted = [Parted(track, self._album.take(track.track)) for track in self._left]
        self._left = []
        return parted

    def tracks_now(self) -> tuple[TrackNow, ...]:
        """Return the fruit in view."""
        if not self._live:
            return ()
        above, mounts = self.above, self.rig.mounts
        positions_m, covariances_m2 = self._where()
        places_m = above.places_m(positions_m)
        trails = [self._trails[live.track] for live in self._live]
        trails_m = _each_of([np.array(trail.places_m) for trail in trails], above.places_m)
        outlines = [trail.outline_m(mounts, above, at) for trail, at in zip(trails, positions_m, strict=True)]
        return tuple(
            TrackNow(
                track=live.track,
                position_m=live.position_m,
                covariance_m2=live.covariance_m2,
                views=live.views,
                whole=live.whole,
                place_m=place_m,
                spread=spread,
                trail_m=trail_m,
                footprint_m=footprint_m,
                opinion=self._opinions.of(live.track),
            )
            for live, place_m, spread, trail_m, footprint_m in zip(
                self._live, places_m, above.spreads(places_m, covariances_m2), trails_m,
                _each_of(outlines, above.places_m), strict=True,
            )
        )  # fmt: skip

    def preview(self, arrival: Arrival, sensor: str) -> Preview:
        """Return a frame's picture with the fruit that its sensor (by the station's id) has in it."""
        frame = arrival.frame
        fruit = self._pictured(sensor) if self._live else ()
        return Preview(frame.sensor, sensor, frame.sequence, frame.time_s, frame.color, fruit, arrival.arrived_s)

    def _pictured(self, sensor: str) -> tuple[Pictured, ...]:
        lens, to_sensor = self.rig.mounts[sensor].intrinsics, self._to_sensor[sensor]
        outlines = {track: view.outline_px for view, track in self._tracker.shown if view.sensor == sensor}
        shown = [
            (live, spread)
            for live, spread in zip(self._live, pictured_spreads(lens, to_sensor, *self._where()), strict=True)
            if live.track in outlines or _inside(spread, lens)
        ]

        def in_picture(points_m: F64) -> F64:
            places = to_sensor.apply(points_m)
            behind = places[:, 2] <= NEAREST_M
            places[behind] = 1.0
            pixels = lens.project(places)
            pixels[behind] = np.nan
            return pixels

        trails_px = _each_of([np.array(self._trails[live.track].places_m) for live, _ in shown], in_picture)
        return tuple(
            Pictured(
                live.track, outlines.get(live.track, NOWHERE_PX), spread, trail_px[np.isfinite(trail_px[:, 0])],
                self._opinions.of(live.track),
            )
            for (live, spread), trail_px in zip(shown, trails_px, strict=True)
        )  # fmt: skip

    def _where(self) -> tuple[F64, F64]:
        """Return positions (n, 3) and covariances (n, 3, 3) of the fruit in view."""
        return np.array([one.position_m for one in self._live]), np.array([one.covariance_m2 for one in self._live])


def _each_of(parts: Sequence[F64], mapped: Callable[[F64], F64]) -> list[F64]:
    """Return arrays of points (k, 3) mapped, all in one go: a call costs as much as a hundred points."""
    if not parts:
        return []
    ends = np.cumsum([len(part) for part in parts]).tolist()
    whole = mapped(np.concatenate(parts))
    return [whole[start:end] for start, end in pairwise([0, *ends])]


def _inside(spread: Spread | None, lens: Intrinsics) -> bool:
    return spread is not None and 0 <= spread.x < lens.width and 0 <= spread.y < lens.height
