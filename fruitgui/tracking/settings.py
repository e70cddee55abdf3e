"""How the tracker behaves: every number in one record, with the reason beside it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TrackerSettings:
    """Numbers of the tracker, metres and seconds; the defaults follow from fruit and belts, not from a scene.

    Attributes:
        slip_speed_m_s: how fast fruit rock, slide or roll against the belt (one standard deviation).
        slip_time_s: how long such a movement lasts.
        model_std_m: floor of what two estimates of one centre may differ by; only for deciding, never in a covariance.
        gate: largest squared Mahalanobis distance of a match (χ², 3 degrees of freedom, 99.9 %).
        lasting_share: share of a centre's variance that stays from capture to capture (shape, side seen).
        same_side_share: share of a centre's variance that two captures from the same side have in common.
        same_side_m: way after which a fruit shows a sensor another side.
        kept_views: sightings kept per track; beyond that they are thinned evenly along the way.
        least_views: views that a fruit needs to be counted, and whole views where it did not cross.
        out_of_view_m: how far outside of every picture the centre must be to have left.
        lost_after_s: a fruit unseen for so long, though its place was in view and others moved on, is finished.
        lost_frames: frames that must have shown its place empty in that time.
        start_s: longest time that the search for the belt's first motion may hold observations back.
    """

    slip_speed_m_s: float = 0.015
    slip_time_s: float = 1.0
    model_std_m: float = 0.006
    gate: float = 16.3
    lasting_share: float = 0.5
    same_side_share: float = 0.9
    same_side_m: float = 0.15
    kept_views: int = 80
    least_views: int = 3
    out_of_view_m: float = 0.03
    lost_after_s: float = 4.0
    lost_frames: int = 20
    start_s: float = 6.0
