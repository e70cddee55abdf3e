"""Two ways to track, put together from the same kinds of parts: ours and the source's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.consider import ConsiderFilter
from fruitgui.tracking.field import FieldOfView
from fruitgui.tracking.follow import BeltFollower, BeltModel, ConstantBelt
from fruitgui.tracking.matching import Association, ClosestPair, OptimalAssignment
from fruitgui.tracking.measured import Centre, Measured, centre_of, mean_of
from fruitgui.tracking.paper import PaperFilter, preset_errors, station_errors
from fruitgui.tracking.presets import PaperPreset, paper_preset
from fruitgui.tracking.resolve import EveryTrail, Majority, Resolver
from fruitgui.tracking.second_look import SecondLook, WiderLook, no_second_look
from fruitgui.tracking.settings import TrackerSettings


class PositionFilter(Protocol):
    """Positions of n fruit and how sure they are."""

    @property
    def position_m(self) -> F64:
        """(n, 3), reference frame."""

    @property
    def position_covariance_m2(self) -> F64:
        """(n, 3, 3)."""

    def __len__(self) -> int: ...

    def predict(self, duration_s: float, displacement_m: F64) -> None:
        """Carry all fruit along with the belt."""

    def shift(self, displacement_m: F64) -> None:
        """Move all fruit by what their common motion was mispredicted by."""

    def innovations(self, tracks: Ints, views: Ints, seen: Measured) -> tuple[F64, F64]:
        """Return residuals (k, 3) and their covariances (k, 3, 3) of pairs of track and view."""

    def update(self, tracks: Ints, views: Ints, seen: Measured) -> None:
        """Take views as measurements of tracks."""

    def add(self, views: Ints, seen: Measured) -> None:
        """Begin a track at each of the views."""

    def keep(self, which: Bools) -> None:
        """Drop the tracks that are not in `which`."""

    def loosen(self, track: int, speed_m_s: float, displacement_m: float) -> None:
        """Let one fruit go its own way."""


@dataclass(frozen=True, slots=True)
class TrackingMode:
    """The parts of one way to track.

    Attributes:
        centre: what of a view is the measurement.
        filter: makes the filter for a rig.
        belt: makes the belt's model from a first motion and its time.
        association: pairs tracks with views.
        second_look: makes what compares again views and tracks that were left over.
        resolver: decides which trails are fruit.
        model_std_m: floor of residuals for deciding matches.
    """

    centre: Centre
    filter: Callable[[Rig], PositionFilter]
    belt: Callable[[Rig, BeltMotion, float], BeltModel]
    association: Association
    second_look: Callable[[Rig, FieldOfView], SecondLook]
    resolver: Resolver
    model_std_m: float


def product_mode(settings: TrackerSettings) -> TrackingMode:
    """Return our way: centres, considered poses, a followed belt, optimal assignment, majority of frames."""
    return TrackingMode(
        centre=centre_of,
        filter=lambda rig: ConsiderFilter(rig, settings),
        belt=BeltFollower,
        association=OptimalAssignment(settings.gate),
        second_look=WiderLook,
        resolver=Majority(settings),
        model_std_m=settings.model_std_m,
    )


def paper_mode(settings: TrackerSettings, preset: PaperPreset | None = None) -> TrackingMode:
    """Return the source's way; pose errors of the preset, or the station's own where none is given."""
    values = paper_preset()

    def make_filter(rig: Rig) -> PositionFilter:
        errors = station_errors(rig) if preset is None else preset_errors(rig, preset)
        return PaperFilter(rig, errors, values.process_m2)

    return TrackingMode(
        centre=mean_of,
        filter=make_filter,
        belt=lambda _rig, motion, time_s: ConstantBelt(motion, time_s),
        association=ClosestPair(settings.gate),
        second_look=lambda _rig, _field: no_second_look,
        resolver=EveryTrail(settings),
        model_std_m=0.0,
    )
