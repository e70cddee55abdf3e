"""From finished trails to fruit: settle who is who, decide what counts, smooth the path."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.bodies import surface_m
from fruitgui.tracking.resolve import Resolver
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.smooth import smoothed_path
from fruitgui.tracking.track import Sighting, Track
from fruitgui.tracking.trail import NEIGHBOUR_M, Trail

LATE_NEIGHBOUR_M = 0.3
"""A fruit given out is remembered while anything is followed this near to it: a piece of it may still come."""


class Closing:
    """Trails that left, held until their neighbours have left too, so that all evidence is in."""

    def __init__(self, rig: Rig, settings: TrackerSettings, resolver: Resolver) -> None:
        self._rig = rig
        self._settings = settings
        self._resolver = resolver
        self._held: list[tuple[Trail, bool]] = []
        self._done: list[Trail] = []

    def close(self, trail: Trail, crossed: bool) -> None:
        """Take a trail that is followed no longer; `crossed`: it left the field by itself."""
        self._held.append((trail, crossed))

    def release(self, live: Sequence[Trail]) -> list[Track]:
        """Return the fruit among the held trails that have no live neighbour."""
        if not self._held:
            return []
        places = _places(live)
        ready = [held for held in self._held if not _has_neighbour(held[0], places)]
        tracks: list[Track] = []
        for trail, crossed in ready:
            tracks += self._settle(trail, crossed, live)
        if self._done:
            followed = _places([*live, *(trail for trail, _ in self._held)])
            self._done = [trail for trail in self._done if _has_neighbour(trail, followed, LATE_NEIGHBOUR_M)]
        return tracks

    def release_all(self) -> list[Track]:
        """Return the fruit among all held trails."""
        return self.release(())

    def _settle(self, trail: Trail, crossed: bool, live: Sequence[Trail]) -> list[Track]:
        self._held = [held for held in self._held if held[0] is not trail]
        others = [held[0] for held in self._held] + list(live) + self._done
        twin = self._resolver.twin(trail, others)
        if twin is not None:
            if _like(trail, twin) and twin not in self._done:
                twin.absorb(trail, self._settings.kept_views)
            return []
        if not self._resolver.counts(trail, crossed) or self._resolver.is_part(trail, others, self._rig):
            return []
        track = track_of(trail, self._rig, self._settings)
        trail.surface_m = surface_m(trail, self._rig)
        trail.entries = []
        self._done.append(trail)
        return [track]


def track_of(trail: Trail, rig: Rig, settings: TrackerSettings) -> Track:
    """Return the track of a trail that has a sighting: its path is smoothed, its sightings are in order of time."""
    entries = sorted(trail.entries, key=lambda entry: entry.time_s)
    duration = entries[-1].time_s - entries[0].time_s
    way = entries[-1].travelled_m - entries[0].travelled_m
    return Track(
        track=trail.number,
        sightings=tuple(Sighting(entry.time_s, entry.view) for entry in entries),
        path=smoothed_path(entries, rig, settings),
        velocity_m_s=way / duration if duration > 0 else np.zeros(3),
    )


def _places(trails: Sequence[Trail]) -> F64:
    """Return where trails lie on the belt, (n, 3)."""
    return np.array([trail.place_m for trail in trails]).reshape(-1, 3)


def _has_neighbour(trail: Trail, places_m: F64, within_m: float = NEIGHBOUR_M) -> bool:
    apart = places_m - trail.place_m
    return bool(((apart * apart).sum(axis=1) < within_m**2).any())


def _like(trail: Trail, twin: Trail) -> bool:
    """Tell whether a duplicate's views show the same body: neither a piece of it nor the group it was in."""
    return bool(0.75 < trail.size_m / max(twin.size_m, 1e-3) < 1.3)
