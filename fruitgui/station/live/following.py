"""The middle of the line: observations in order in, fruit that left out, and what is in view to be drawn."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, F64, Frame
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.perception.view import FruitView, Observation
from fruitgui.sensors.feed import Arrival
from fruitgui.station.live.above import FromAbove, pictured_spread
from fruitgui.station.live.bench import Bench
from fruitgui.station.live.bump import BumpWatch
from fruitgui.station.live.crops import Album, Cut
from fruitgui.station.live.opinions import Opinions
from fruitgui.station.live.state import Pictured, Preview, TrackNow
from fruitgui.station.prelude import known_belt
from fruitgui.station.station import Station
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import LiveTrack, Tracker

TRAIL_STEP_M = 0.015
TRAIL_LENGTH = 64
"""A trail has a point every so far, and the last so many: a metre of way."""

TELLING_FRUIT = 3

NOWHERE_PX: F32 = np.zeros((0, 2), dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Parted:
    """A fruit that has left: its track, and the cuts of it, the best first."""

    track: Track
    cuts: tuple[Cut, ...]


class _Trail:
    """Where one fruit was, and what it looked like from above when it was last seen; reference frame."""

    def __init__(self) -> None:
        self.places_m: deque[F64] = deque(maxlen=TRAIL_LENGTH)
        self.footprint_m: F64 = np.zeros((0, 3))
        self.seen_at_m: F64 = np.zeros(3)

    def note(self, position_m: F64) -> None:
        """Add a place, if it is a step farther."""
        if not self.places_m or float(np.linalg.norm(position_m - self.places_m[-1])) >= TRAIL_STEP_M:
            self.places_m.append(position_m)

    def see(self, view: FruitView, mount: Mount, position_m: F64, above: FromAbove) -> None:
        """Take the outline of what a sensor saw, laid on the belt."""
        points = mount.pose.apply(view.points_m)
        if len(points) < 3:
            return
        hull = cv2.convexHull(above.places_m(points).astype(np.float32), returnPoints=False)
        self.footprint_m, self.seen_at_m = points[hull[:, 0]], position_m

    def carried_m(self, position_m: F64) -> F64:
        """Return the outline (K, 3), carried along to where the fruit is now."""
        return self.footprint_m + (position_m - self.seen_at_m)


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
        self._album = Album()
        self._opinions = Opinions(bench)
        self._trails: dict[int, _Trail] = {}
        self._live: tuple[LiveTrack, ...] = ()
        self.velocity_m_s: F64 | None = station.velocity_m_s
        self.above.head_along(station.velocity_m_s)

    def follow(self, frame: Frame, observation: Observation, now_s: float) -> list[Parted]:
        """Take an observation and its frame; return the fruit that it finished."""
        self._bumps.see_frame(observation.sensor, frame)
        tracks = self._update(observation)
        for view, track in self._tracker.shown:
            self._album.look(track, view, frame)
        self._opinions.form(self._tracker, self._live, now_s)
        return self._parted(tracks)

    def begin_anew(self, cuts: Iterable[Cut]) -> None:
        """Forget all fruit in view; what was seen of them will come again.

        Args:
            cuts: of fruit that left and will leave again.
        """
        self._tracker = Tracker(self.rig, self._known_belt)
        self._opinions = Opinions(self._bench)
        self._trails, self._live = {}, ()
        self._album.begin_anew(cuts)

    def follow_again(self, observation: Observation) -> list[Parted]:
        """Take an observation that was followed before, without its frame; return the fruit that it finished."""
        tracks = self._update(observation)
        for view, track in self._tracker.shown:
            self._album.find(track, view)
        return self._parted(tracks)

    def _update(self, observation: Observation) -> list[Track]:
        tracks = self._tracker.update(observation)
        self._live = self._tracker.live
        self._watch_belt()
        self._note()
        return tracks

    @property
    def stale(self) -> dict[tuple[str, ...], str]:
        """Which sensors were bumped, in words."""
        return self._bumps.close.stale

    def finish(self) -> list[Parted]:
        """Return the fruit still in view, as far as they count; nothing is in view afterwards."""
        tracks = self._tracker.finish()
        self._live = ()
        return self._parted(tracks)

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
                self._trails[track].see(view, self.rig.mounts[view.sensor], places[track], self.above)

    def see_off(self, parted: Parted) -> None:
        """Look at a fruit that left for good, for whether two sensors saw it at one place."""
        self._bumps.close.see_track(parted.track)

    def _parted(self, tracks: list[Track]) -> list[Parted]:
        return [Parted(track, self._album.take(track.track)) for track in tracks]

    def tracks_now(self) -> tuple[TrackNow, ...]:
        """Return the fruit in view."""
        return tuple(self._now(one) for one in self._live)

    def _now(self, live: LiveTrack) -> TrackNow:
        trail, above = self._trails[live.track], self.above
        place_m = above.places_m(live.position_m)[0]
        return TrackNow(
            track=live.track,
            position_m=live.position_m,
            covariance_m2=live.covariance_m2,
            views=live.views,
            whole=live.whole,
            unseen_s=live.time_s - live.last_seen_s,
            place_m=place_m,
            spread=above.spread(place_m, live.covariance_m2),
            trail_m=above.places_m(np.array(trail.places_m)),
            footprint_m=above.places_m(trail.carried_m(live.position_m)),
            opinion=self._opinions.of(live.track),
        )

    def preview(self, arrival: Arrival, sensor: str) -> Preview:
        """Return a frame's picture with the fruit that its sensor (by the station's id) has in it."""
        frame, mount = arrival.frame, self.rig.mounts[sensor]
        outlines = {track: view.outline_px for view, track in self._tracker.shown if view.sensor == sensor}
        pictured = [self._pictured(one, mount, outlines) for one in self._live]
        fruit = tuple(one for one in pictured if one is not None)
        return Preview(frame.sensor, sensor, frame.sequence, frame.time_s, frame.color, fruit, arrival.arrived_s)

    def _pictured(self, live: LiveTrack, mount: Mount, outlines: Mapping[int, F32]) -> Pictured | None:
        outline = outlines.get(live.track)
        spread = pictured_spread(mount, live.position_m, live.covariance_m2)
        lens = mount.intrinsics
        if outline is None and (spread is None or not (0 <= spread.x < lens.width and 0 <= spread.y < lens.height)):
            return None
        places = mount.pose.inverse().apply(np.array(self._trails[live.track].places_m))
        trail_px = lens.project(places[places[:, 2] > 0.05])
        opinion = self._opinions.of(live.track)
        return Pictured(live.track, NOWHERE_PX if outline is None else outline, spread, trail_px, opinion)
