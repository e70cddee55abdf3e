"""Views that no track claimed and tracks that no view claimed, compared once more before a new fruit is begun."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.field import FieldOfView
from fruitgui.tracking.measured import Measured, look_distance
from fruitgui.tracking.trail import NEIGHBOUR_M, Trail

LOOSE_SHARE = 0.55
"""A view whose centre lies within this share of a fruit's size from it is that fruit, badly seen: two solid
bodies cannot come closer than about a whole size."""

SHOWN_APART = 2
"""Frames that must have shown two tracks as two views before one view may be taken for both."""

ROLLING_M_S = 0.7
ROLLING_S = 0.6
ENTRY_M = 0.15
"""Nearer to the field's edge than this, an unclaimed view is rather a fruit that has just come in."""


@dataclass(frozen=True, slots=True, eq=False)
class Claims:
    """Which view belongs to which track.

    Attributes:
        tracks, views: (k,) the pairs.
        seen: the observation, with covariances widened where a claim was loose.
        strayed: tracks among them that left their predicted way.
        merged: for each view that covers several tracks, these tracks.
        covering: the views that do.
    """

    tracks: Ints
    views: Ints
    seen: Measured
    strayed: tuple[int, ...] = ()
    merged: tuple[tuple[int, ...], ...] = ()
    covering: tuple[int, ...] = ()

    def free_views(self) -> Ints:
        """Return the views that belong to nothing yet."""
        free = np.ones(len(self.seen), dtype=bool)
        free[self.views] = False
        free[list(self.covering)] = False
        return np.flatnonzero(free)

    def free_tracks(self, number: int) -> Ints:
        """Return which of `number` tracks no view belongs to."""
        free = np.ones(number, dtype=bool)
        free[self.tracks] = False
        free[[track for tracks in self.merged for track in tracks]] = False
        return np.flatnonzero(free)

    def with_pairs(self, tracks: Sequence[int], views: Sequence[int]) -> Claims:
        """Return these claims and more pairs."""
        return replace(
            self,
            tracks=np.concatenate([self.tracks, tracks]).astype(np.intp),
            views=np.concatenate([self.views, views]).astype(np.intp),
        )


class SecondLook(Protocol):
    """Compares again what the first matching left over."""

    def __call__(self, claims: Claims, position_m: F64, trails: Sequence[Trail]) -> Claims:
        """Return the claims with what was found; positions (n, 3) are the tracks' predicted ones."""


def no_second_look(claims: Claims, position_m: F64, trails: Sequence[Trail]) -> Claims:  # noqa: ARG001 - the protocol
    """Return the claims as they are: the source begins a new fruit at once."""
    return claims


class WiderLook:
    """Groups that were not separated, fruit badly seen, fruit that rolled away: in this order."""

    def __init__(self, rig: Rig, field: FieldOfView) -> None:
        self._rig = rig
        self._field = field
        self._belt = rig.belt_frame()

    def __call__(self, claims: Claims, position_m: F64, trails: Sequence[Trail]) -> Claims:
        """Return the claims with groups, loose matches and strays found."""
        claims = self._groups(claims, position_m, trails)
        claims = self._badly_seen(claims, position_m, trails)
        return self._strayed(claims, position_m, trails)

    def _groups(self, claims: Claims, position_m: F64, trails: Sequence[Trail]) -> Claims:
        """Find views that cover two or more tracks that are known apart."""
        missing = {int(i) for i in claims.free_tracks(len(trails)) if trails[i].clear >= 3}
        if not missing:
            return claims
        owner = dict(zip(claims.views.tolist(), claims.tracks.tolist(), strict=True))
        keep = np.ones(len(claims.tracks), dtype=bool)
        merged, covering = list(claims.merged), list(claims.covering)
        for view in range(len(claims.seen)):
            own = owner.get(view)
            if own is not None and claims.seen.size_m[view] < 1.2 * trails[own].size_m:
                continue
            near = self._near(claims.seen.position_m[view], position_m, missing | ({own} if own is not None else set()))
            covered = self._covered(claims.seen, view, position_m, near, trails) if len(near) > 1 else []
            covered = _known_apart(covered, trails)
            if len(covered) > 1 and (own is None or own in covered):
                merged.append(tuple(covered))
                covering.append(view)
                keep &= claims.views != view
                missing -= set(covered)
        return replace(
            claims, tracks=claims.tracks[keep], views=claims.views[keep], merged=tuple(merged), covering=tuple(covering)
        )

    @staticmethod
    def _near(place_m: F64, position_m: F64, tracks: set[int]) -> list[int]:
        return [track for track in sorted(tracks) if np.linalg.norm(position_m[track] - place_m) < NEIGHBOUR_M]

    def _covered(
        self, seen: Measured, view: int, position_m: F64, tracks: list[int], trails: Sequence[Trail]
    ) -> list[int]:
        """Return which tracks have seen surface of this view above their middle."""
        points = seen.views[view].points_m
        step = max(1, len(points) // 300)
        surface = self._belt.apply(self._rig.mounts[seen.sensor].pose.apply(points[::step]))
        centres = self._belt.apply(position_m[tracks])
        apart = np.linalg.norm(surface[None, :, :2] - centres[:, None, :2], axis=2)
        above = surface[None, :, 2] > 0.8 * centres[:, None, 2]
        size = np.array([trails[track].size_m for track in tracks])
        covers = ((apart < 0.25 * size[:, None]) & above).sum(axis=1) >= 3
        return [track for track, under in zip(tracks, covers.tolist(), strict=True) if under]

    def _badly_seen(self, claims: Claims, position_m: F64, trails: Sequence[Trail]) -> Claims:
        """Give a view to the free track inside whose body its centre lies."""
        views, tracks = claims.free_views(), claims.free_tracks(len(trails))
        if not len(views) or not len(tracks):
            return claims
        size = np.array([max(trails[i].size_m, 0.03) for i in tracks])
        apart = np.linalg.norm(claims.seen.position_m[views][None] - position_m[tracks][:, None], axis=2)
        pairs = _closest(apart, apart < LOOSE_SHARE * np.maximum(size[:, None], claims.seen.size_m[views][None]))
        covariance = claims.seen.covariance_m2.copy()
        for i, j in pairs:
            covariance[views[j]] += (0.5 * apart[i, j]) ** 2 * np.eye(3)
        claims = replace(claims, seen=replace(claims.seen, covariance_m2=covariance))
        return claims.with_pairs([int(tracks[i]) for i, _ in pairs], [int(views[j]) for _, j in pairs])

    def _strayed(self, claims: Claims, position_m: F64, trails: Sequence[Trail]) -> Claims:
        """Find the fruit that rolled: gone from its place, while one like it turned up where none could come in."""
        seen = claims.seen
        free = claims.free_tracks(len(trails))
        tracks = free[[self._may_roll(i, position_m, trails, seen) for i in free.tolist()]] if len(free) else free
        views = claims.free_views()
        views = views[self._alone(views, claims, position_m)] if len(views) and len(tracks) else views[:0]
        if not len(views) or not len(tracks):
            return claims
        since = np.array([seen.time_s - trails[i].last_s for i in tracks])
        apart = np.linalg.norm(seen.position_m[views][None] - position_m[tracks][:, None], axis=2)
        unlike = look_distance(np.array([trails[i].looks for i in tracks]), seen.looks[views])
        allowed = (apart < 0.02 + ROLLING_M_S * since[:, None]) & (unlike < 8.0)
        only = (allowed.sum(axis=0, keepdims=True) == 1) & (allowed.sum(axis=1, keepdims=True) == 1)
        pairs = _closest(apart, allowed & only)
        strayed = tuple(int(tracks[i]) for i, _ in pairs)
        return replace(claims.with_pairs(strayed, [int(views[j]) for _, j in pairs]), strayed=claims.strayed + strayed)

    @staticmethod
    def _may_roll(track: int, position_m: F64, trails: Sequence[Trail], seen: Measured) -> bool:
        """Tell whether a missing fruit was seen well and lately, and no group is near that hides it."""
        trail = trails[track]
        neighbours = np.linalg.norm(position_m - position_m[track], axis=1) < NEIGHBOUR_M
        return int(neighbours.sum()) == 1 and trail.clear >= 2 and seen.time_s - trail.last_s < ROLLING_S

    def _alone(self, views: Ints, claims: Claims, position_m: F64) -> Bools:
        """Tell which views lie well inside the field and apart from every claimed track."""
        inside = self._field.depth_m(claims.seen.position_m[views]) > ENTRY_M
        claimed = position_m[claims.tracks]
        if not len(claimed):
            return inside
        apart = np.linalg.norm(claims.seen.position_m[views][:, None] - claimed[None], axis=2).min(axis=1)
        return np.asarray(inside & (apart > claims.seen.size_m[views]))


def _known_apart(tracks: Sequence[int], trails: Sequence[Trail]) -> list[int]:
    """Return those of the tracks that frames showed beside another of them: not halves of one cut at the edge."""
    return [
        track
        for track in tracks
        if any(trails[track].shown_beside(trails[other]) >= SHOWN_APART for other in tracks if other != track)
    ]


def _closest(apart: F64, allowed: Bools) -> list[tuple[int, int]]:
    """Return allowed pairs (row, column), closest first, none twice."""
    pairs: list[tuple[int, int]] = []
    rows, columns = np.nonzero(allowed)
    used_rows: set[int] = set()
    used_columns: set[int] = set()
    for k in np.argsort(apart[rows, columns], kind="stable"):
        row, column = int(rows[k]), int(columns[k])
        if row not in used_rows and column not in used_columns:
            pairs.append((row, column))
            used_rows.add(row)
            used_columns.add(column)
    return pairs
