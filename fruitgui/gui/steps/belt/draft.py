"""The belt as a person is setting it, before it is saved: a region with its history, a motion, heights of fruit."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from fruitgui.frame import F64
from fruitgui.station.belt_setting import (
    PlanMotion,
    long_axis_rad,
    motion_of,
    region_of,
    region_problem,
    with_motion,
    with_region,
)
from fruitgui.station.station import Station

USUAL_M_S = 0.1

USUAL_HEIGHTS_M = (0.025, 0.15)
"""From a small plum to a melon on its end."""


@dataclass(frozen=True, slots=True, eq=False)
class Draft:
    """What is on the screen.

    Attributes:
        corners_m: (K, 2) of the region on the plan.
        axis_rad: heading of the belt's long side on the plan: it lies from left to right on the screen.
        fixed: whether the belt's motion is fixed; else every run measures it.
        speed_m_s: of the belt. backwards: from right to left. turned_rad: from the long side.
        shortest_m, tallest_m: heights of fruit.
        before: how it was before the last change to the corners; None where nothing was changed.
        dragging: how it was when the corner was taken that is being dragged; None where none is.
    """

    corners_m: F64
    axis_rad: float
    fixed: bool
    speed_m_s: float
    backwards: bool
    turned_rad: float
    shortest_m: float
    tallest_m: float
    before: Draft | None = None
    dragging: Draft | None = None

    def held(self, base: Draft) -> Draft:
        """Return the draft while a corner is dragged that was taken at `base`: one drag is one change."""
        return replace(self, dragging=base)

    @property
    def motion(self) -> PlanMotion | None:
        """The belt's motion; None where every run measures it."""
        if not self.fixed:
            return None
        heading = self.axis_rad + self.turned_rad + (math.pi if self.backwards else 0.0)
        return PlanMotion(self.speed_m_s, heading)

    @property
    def problem(self) -> str:
        """Why it cannot be saved: of the region, or `heights`; empty where it can."""
        return region_problem(self.corners_m) or ("heights" if self.shortest_m >= self.tallest_m else "")


def draft_of(station: Station) -> Draft:
    """Return a draft of what is saved."""
    corners_m = region_of(station)
    shortest_m, tallest_m = station.fruit_heights_m or USUAL_HEIGHTS_M
    draft = Draft(
        corners_m=corners_m,
        axis_rad=long_axis_rad(corners_m),
        fixed=False,
        speed_m_s=USUAL_M_S,
        backwards=False,
        turned_rad=0.0,
        shortest_m=shortest_m,
        tallest_m=tallest_m,
    )
    motion = motion_of(station)
    return draft if motion is None else with_measured(draft, motion)


def with_measured(draft: Draft, motion: PlanMotion) -> Draft:
    """Return a draft with a motion, told as speed, direction and a small turn from the long side."""
    turned = (motion.heading_rad - draft.axis_rad + math.pi) % (2.0 * math.pi) - math.pi
    backwards = abs(turned) > math.pi / 2
    if backwards:
        turned -= math.copysign(math.pi, turned)
    return replace(draft, fixed=True, speed_m_s=motion.speed_m_s, backwards=backwards, turned_rad=turned)


def moved(draft: Draft, corner: int, to_m: F64) -> Draft:
    """Return a draft with a corner elsewhere; where that makes no region, the draft as it is."""
    corners = draft.corners_m.copy()
    corners[corner] = to_m
    return _changed(draft, corners)


def added(draft: Draft, corner: int) -> Draft:
    """Return a draft with another corner, half-way from a corner to the next."""
    following = draft.corners_m[(corner + 1) % len(draft.corners_m)]
    middle = (draft.corners_m[corner] + following) / 2.0
    return _changed(draft, np.insert(draft.corners_m, corner + 1, middle, axis=0))


def removed(draft: Draft, corner: int) -> Draft:
    """Return a draft without a corner; the last three stay."""
    return _changed(draft, np.delete(draft.corners_m, corner, axis=0))


def undone(draft: Draft) -> Draft:
    """Return the draft with the corners as they were before the last change."""
    if draft.before is None:
        return draft
    earlier = draft.before
    return replace(draft, corners_m=earlier.corners_m, before=earlier.before)


def _changed(draft: Draft, corners_m: F64) -> Draft:
    if region_problem(corners_m):
        return draft
    return replace(draft, corners_m=corners_m, before=draft, dragging=None)


def saved_in(draft: Draft, station: Station) -> Station:
    """Return the station with what the draft says of the belt."""
    whole = with_motion(with_region(station, draft.corners_m), draft.motion)
    return replace(whole, fruit_heights_m=(draft.shortest_m, draft.tallest_m))
