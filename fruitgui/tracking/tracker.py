"""The tracker: views of all sensors in the order of their times in, finished fruit out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import FruitView, Observation
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.bodies import SMALLEST_M
from fruitgui.tracking.closing import Closing, track_of
from fruitgui.tracking.field import FieldOfView
from fruitgui.tracking.follow import BeltModel
from fruitgui.tracking.matching import Pairs
from fruitgui.tracking.measured import Measured, distances_m, look_distance, measured, variances
from fruitgui.tracking.mode import TrackingMode, product_mode
from fruitgui.tracking.second_look import Claims
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.start import Start
from fruitgui.tracking.track import Track
from fruitgui.tracking.trail import NEIGHBOUR_M, Entry, Trail

CLUTTER_FRAMES = 6
"""A track of one or two views whose place then shows nothing for so many frames was never there."""

_EYE = np.eye(3)


@dataclass(frozen=True, slots=True, eq=False)
class LiveTrack:
    """A fruit in view, for the screen.

    Attributes:
        track: its number.
        position_m: (3,) centre of volume at the last observation, reference frame. covariance_m2: (3, 3) of it.
        views: how often it was seen.
        whole: how often seen whole.
    """

    track: int
    position_m: F64
    covariance_m2: F64
    views: int
    whole: int


class Tracker:
    """Follows all fruit of one rig; numbers belong to the instance.

    Observations come in order of reference time; sensors may be silent, and two may
    share a time. A capture that comes late is still used. Without a belt motion the
    first observations are held back until the fruit show it.
    """

    def __init__(
        self,
        rig: Rig,
        belt: BeltMotion | None = None,
        settings: TrackerSettings | None = None,
        mode: TrackingMode | None = None,
    ) -> None:
        self._settings = settings or TrackerSettings()
        self._mode = mode or product_mode(self._settings)
        self._rig = rig
        self._field = FieldOfView.of(rig)
        self._filter = self._mode.filter(rig)
        self._look_again = self._mode.second_look(rig, self._field)
        self._closing = Closing(rig, self._settings, self._mode.resolver)
        self._start = Start(rig, belt, self._settings.start_s)
        self._belt: BeltModel | None = None
        self._trails: list[Trail] = []
        self._numbers = 0
        self._time_s = -np.inf
        self._shown: list[tuple[FruitView, int]] = []

    @property
    def shown(self) -> tuple[tuple[FruitView, int], ...]:
        """The views of the last observation that belong to a track, each with the track's number."""
        return tuple(self._shown)

    def so_far(self, number: int) -> Track | None:
        """Return a fruit in view as if it had left now; None where none is followed under that number."""
        trail = next((one for one in self._trails if one.number == number), None)
        return None if trail is None else track_of(trail, self._rig, self._settings)

    @property
    def belt(self) -> BeltMotion | None:
        """The belt's mean velocity while it ran; None while the fruit have not shown it."""
        return None if self._belt is None else self._belt.mean_motion()

    @property
    def belt_now(self) -> BeltMotion | None:
        """The belt's velocity at the last observation; None while the fruit have not shown it."""
        return None if self._belt is None else self._belt.motion()

    @property
    def live(self) -> tuple[LiveTrack, ...]:
        """The fruit in view, as of the last observation."""
        position, covariance = self._filter.position_m, self._filter.position_covariance_m2
        return tuple(
            LiveTrack(
                track=trail.number,
                position_m=position[i].copy(),
                covariance_m2=covariance[i].copy(),
                views=trail.views,
                whole=trail.whole,
            )
            for i, trail in enumerate(self._trails)
        )

    def update(self, observation: Observation) -> list[Track]:
        """Take one observation; return the fruit that it finished, in order of their leaving.

        Raises:
            InputError: the rig has no such sensor.
        """
        seen = measured(observation, self._rig, self._field, self._mode.centre)
        if self._belt is not None:
            return self._step(seen)
        self._start.hold(seen)
        return self._begin(self._start.motion())

    def finish(self) -> list[Track]:
        """Return the fruit still being followed, as far as they count; the tracker is empty afterwards."""
        finished = [] if self._belt is not None else self._begin(self._start.last_motion())
        for trail in self._trails:
            self._closing.close(trail, crossed=False)
        self._drop(np.zeros(len(self._trails), dtype=bool))
        return finished + self._closing.release_all()

    def _begin(self, motion: BeltMotion | None) -> list[Track]:
        if motion is None:
            return []
        held = self._start.release()
        self._time_s = held[0].time_s if held else 0.0
        self._belt = self._mode.belt(self._rig, motion, self._time_s)
        return [track for seen in held for track in self._step(seen)]

    def _step(self, seen: Measured) -> list[Track]:
        self._shown.clear()
        belt = self._belt
        assert belt is not None  # noqa: S101 - only called once the belt's model stands
        late = seen.time_s < self._time_s
        self._filter.predict(seen.time_s - self._time_s, belt.advance(seen.time_s))
        self._time_s = seen.time_s
        looks = np.array([trail.looks for trail in self._trails])
        if len(seen) and self._trails and not late:
            variance = variances(self._filter.position_covariance_m2)
            missed = belt.correct(self._filter.position_m, variance, looks, self._steady(), seen)
            self._filter.shift(missed)
        claims = self._claims(seen, looks)
        for track in claims.strayed:
            self._filter.loosen(track, speed_m_s=0.3, displacement_m=0.03)
        self._filter.update(claims.tracks, claims.views, claims.seen)
        self._record(claims, belt.travelled_m())
        self._add(claims, belt.travelled_m())
        return self._close()

    def _steady(self) -> Bools:
        """Tell which tracks can say how the belt moved: seen lately, and not only cut by an edge."""
        lately = np.array([trail.unseen < 5 for trail in self._trails], dtype=bool)
        clear = np.array([trail.clear > 0 for trail in self._trails], dtype=bool)
        return lately & clear if (lately & clear).any() else lately

    def _claims(self, seen: Measured, looks: F64) -> Claims:
        """Return which view belongs to which track, whose looks (n, 5) are given."""
        none = np.zeros(0, dtype=np.intp)
        if not len(seen) or not self._trails:
            return Claims(none, none, seen)
        tracks, views, apart = self._near_pairs(seen)
        residual, S = self._filter.innovations(tracks, views, seen)
        S = S + self._mode.model_std_m**2 * _EYE
        squared = np.einsum("ki,ki->k", residual, np.linalg.solve(S, residual[:, :, None])[:, :, 0])
        unlike = look_distance(looks, seen.looks)[tracks, views]
        taken = self._mode.association.match(Pairs(tracks, views, squared, unlike, apart))
        claims = Claims(tracks[taken], views[taken], seen)
        return self._look_again(claims, self._filter.position_m, self._trails)

    def _near_pairs(self, seen: Measured) -> tuple[Ints, Ints, F64]:
        """Return the pairs (track, view) worth a closer look, and how far apart they are in units of their size."""
        position, covariance = self._filter.position_m, self._filter.position_covariance_m2
        std, own = np.sqrt(3.0 * variances(covariance)), np.sqrt(3.0 * variances(seen.covariance_m2))
        distance = distances_m(position, seen.position_m)
        tracks, views = np.nonzero(distance < 0.04 + 4.1 * (std[:, None] + own[None]))
        size = np.array([trail.size_m for trail in self._trails])
        body = np.maximum(np.maximum(size[tracks], seen.size_m[views]), SMALLEST_M)
        since = np.array([self._time_s - trail.last_s for trail in self._trails])
        slipped = np.minimum(2.0 * self._settings.slip_speed_m_s * since[tracks], 0.5 * body)
        return tracks, views, np.maximum(distance[tracks, views] - slipped, 0.0) / body

    def _record(self, claims: Claims, travelled_m: F64) -> None:
        """Write down who was seen, who was not, and in whose company."""
        position = self._filter.position_m
        for trail, place in zip(self._trails, position, strict=True):
            trail.position_m, trail.travelled_m = place, travelled_m
        depth = self._field.sensors[claims.seen.sensor].depth_m(position) if self._trails else np.zeros(0)
        hit = np.zeros(len(self._trails), dtype=bool)
        hit[claims.tracks] = True
        covered = np.zeros(len(self._trails), dtype=bool)
        for group in claims.merged:
            covered[list(group)] = True
        for trail, inside_m, seen, under in zip(
            self._trails, depth.tolist(), hit.tolist(), covered.tolist(), strict=True
        ):
            should = inside_m > 0.5 * trail.size_m
            trail.expected += should or seen
            trail.unseen = 0 if seen or under else trail.unseen + should
        for track, view in zip(claims.tracks.tolist(), claims.views.tolist(), strict=True):
            self._see(self._trails[track], claims.seen, view, travelled_m)
        self._keep_company(position, depth, hit, claims)

    def _see(self, trail: Trail, seen: Measured, view: int, travelled_m: F64) -> None:
        entry = Entry(
            time_s=seen.time_s,
            view=seen.views[view],
            position_m=seen.position_m[view],
            covariance_m2=seen.covariance_m2[view],
            travelled_m=travelled_m,
            cut=bool(seen.cut[view]),
        )
        trail.see(entry, seen.looks[view], float(seen.size_m[view]), self._settings.kept_views)
        self._shown.append((seen.views[view], trail.number))

    def _keep_company(self, position_m: F64, depth_m: F64, hit: Bools, claims: Claims) -> None:
        """Count, for every two close tracks that this frame should show, whether it showed both, one or a group."""
        if len(position_m) < 2:
            return
        should = (depth_m > 0.02) | hit
        close = np.triu(distances_m(position_m, position_m) < NEIGHBOUR_M, 1) & should[:, None] & should[None]
        groups = [set(group) for group in claims.merged]
        shown = hit.tolist()
        for i, j in np.argwhere(close).tolist():
            group = any(i in members and j in members for members in groups)
            if not (group or shown[i] or shown[j]):
                continue
            both, one = shown[i] and shown[j], shown[i] != shown[j] and not group
            first, second = self._trails[i], self._trails[j]
            for company in (first.company_of(second.number), second.company_of(first.number)):
                company.note(claims.seen.sensor, both, one, group)

    def _add(self, claims: Claims, travelled_m: F64) -> None:
        """Begin a track at every view that belongs to nothing."""
        views = claims.free_views()
        if not len(views):
            return
        self._filter.add(views, claims.seen)
        for view in views.tolist():
            self._numbers += 1
            seen = claims.seen
            trail = Trail(self._numbers, seen.time_s, seen.looks[view].copy(), float(seen.size_m[view]), expected=1)
            trail.position_m, trail.travelled_m = seen.position_m[view], travelled_m
            self._see(trail, seen, view, travelled_m)
            self._trails.append(trail)

    def _close(self) -> list[Track]:
        """Finish the tracks that left, were lost or never were; return the fruit among those that are settled."""
        if not self._trails:
            return self._closing.release(self._trails)
        gone = self._field.depth_m(self._filter.position_m) < -self._settings.out_of_view_m
        stays = np.ones(len(self._trails), dtype=bool)
        for i, trail in enumerate(self._trails):
            left = bool(gone[i]) and trail.last_s < self._time_s
            twin = self._mode.resolver.obvious_twin(trail, self._trails)
            if twin is not None:
                twin.absorb(trail, self._settings.kept_views)
            elif left or self._lost(trail) or _clutter(trail):
                self._closing.close(trail, crossed=left)
            else:
                continue
            stays[i] = False
        self._drop(stays)
        return self._closing.release(self._trails)

    def _lost(self, trail: Trail) -> bool:
        settings = self._settings
        return trail.unseen >= settings.lost_frames and self._time_s - trail.last_s > settings.lost_after_s

    def _drop(self, stays: Bools) -> None:
        if not stays.all():
            self._filter.keep(stays)
            self._trails = [trail for trail, kept in zip(self._trails, stays.tolist(), strict=True) if kept]


def _clutter(trail: Trail) -> bool:
    return trail.views < 3 and trail.unseen >= CLUTTER_FRAMES
