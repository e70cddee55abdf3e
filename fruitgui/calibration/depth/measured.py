"""What is measured to correct a device's depth, and what comes of it: plain records."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.still import Still
from fruitgui.frame import F64, Bools
from fruitgui.sensors.depth_correction import DepthCorrection

TERMS = ("scale", "offset_m", "radial_2", "radial_4")
"""Of a correction, in the order of covariances."""

HEIGHT_STD_M = 0.001
"""A box's height read off a ruler; its lid sags by as much."""

DISTANCE_STD_M = 0.004
"""A tape from the sensor's glass to the belt: where behind the glass the lens begins is known no better."""

DIAMETER_STD_M = 0.0005
"""A ball between two straight edges."""

RAISED_STD_M = 0.0015
"""How much higher a sensor hangs, by a tape held twice: where behind the glass the lens begins cancels."""

LENS_ASIDE_M = 0.05
"""A sensor that is turned while it is raised lifts its lens by another length than its edge, so far aside."""

LEAST_RAISED_M = 0.20
"""From here on a raise alone tells the scale to 1 %, half of what is known of a make."""


@dataclass(frozen=True, slots=True, eq=False)
class BareBelt:
    """The belt (or any wide flat thing) with nothing on it, the first of all measurements.

    Attributes:
        still: uncorrected.
        distance_m: typed: from the sensor's glass straight ahead to the belt; None where it was not measured.
        distance_std_m: how sure that is.
    """

    still: Still
    distance_m: float | None = None
    distance_std_m: float = DISTANCE_STD_M


@dataclass(frozen=True, slots=True, eq=False)
class RaisedBoard:
    """A flat board that lies higher than the belt, the sensor as it was.

    Attributes:
        still: uncorrected.
        height_m: typed: of the board's upper side over the belt.
        height_std_m: how sure that is.
    """

    still: Still
    height_m: float
    height_std_m: float = HEIGHT_STD_M


@dataclass(frozen=True, slots=True, eq=False)
class RaisedSensor:
    """The bare belt once more, seen by the sensor raised straight up.

    Attributes:
        still: uncorrected.
        raised_m: typed: how much farther the sensor is from the belt than in the first of all measurements.
        raised_std_m: how sure that is.
    """

    still: Still
    raised_m: float
    raised_std_m: float = RAISED_STD_M


@dataclass(frozen=True, slots=True, eq=False)
class BallOnBelt:
    """A ball that lies on the belt, the sensor as it was.

    Attributes:
        still: uncorrected.
        diameter_m: typed.
        diameter_std_m: how sure that is.
    """

    still: Still
    diameter_m: float
    diameter_std_m: float = DIAMETER_STD_M


@dataclass(frozen=True, slots=True, eq=False)
class Measurements:
    """Everything that was measured of one device."""

    belt: BareBelt
    boards: tuple[RaisedBoard, ...] = ()
    balls: tuple[BallOnBelt, ...] = ()
    raised: tuple[RaisedSensor, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class SeenFlat:
    """A flat thing as it was read: means over tiles of its pixels, wider than errors of neighbours are alike.

    Attributes:
        rays: (N, 3) homogeneous (x, y, 1).
        inverse: (N,) read inverse depth, 1/m.
        std: (N,) of that, 1/m.
        on: (H, W) pixels that lie on it.
        coefficients: (3,) of the plane read, 1/z = a·(x, y, 1).
    """

    rays: F64
    inverse: F64
    std: F64
    on: Bools
    coefficients: F64


@dataclass(frozen=True, slots=True, eq=False)
class SeenBall:
    """The cap of a ball as it was read, pixel by pixel.

    Attributes:
        rays: (N, 3) homogeneous (x, y, 1).
        inverse: (N,) read inverse depth, 1/m.
        std: of each for least squares that count pixels as independent, 1/m.
        centre_m: (3,) of the ball as read. radius_m: as typed.
        on: (H, W) pixels of the cap.
    """

    rays: F64
    inverse: F64
    std: float
    centre_m: F64
    radius_m: float
    on: Bools


@dataclass(frozen=True, slots=True)
class Figure:
    """One length before and after, m.

    Attributes:
        what: `distance`, `height`, `raised`, `ball`, or `flatness` (root mean square deviation from a plane, typed 0).
        typed_m: what a person measured.
        before_m, after_m: what the device says, uncorrected and corrected.
        std_m: of what it says, from the readings alone.
    """

    what: str
    typed_m: float
    before_m: float
    after_m: float
    std_m: float


@dataclass(frozen=True, slots=True)
class Sureness:
    """How sure a device's depth would be by a part of the measurements.

    Attributes:
        by: `belt` (one height), `heights` (belt, boards, and the belt from higher), `ball` (belt and balls), or `all`.
        scale_std: of the scale.
        offset_std_m: of the offset.
        depth_std_m: of a depth at the belt.
    """

    by: str
    scale_std: float
    offset_std_m: float
    depth_std_m: float


@dataclass(frozen=True, slots=True)
class DepthReason:
    """Why a measurement does not do: a stable word, what is wrong, what to do, and of what `Figure` that is said.

    Codes: `belt_not_seen`, `board_not_seen`, `ball_not_seen`, `raised_belt_not_seen`, `not_flat`, `scene_moved`,
    `sensor_moved`, `height_differs`, `raised_too_little`, `raised_differs`, `too_few_heights`, `nothing_decided`,
    `typed_disagrees`, `implausible`.
    """

    code: str
    what: str
    remedy: str
    about: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class DepthRefusal:
    """Measurements of which no correction can be made."""

    reasons: tuple[DepthReason, ...]


@dataclass(frozen=True, slots=True, eq=False)
class DepthFit:
    """A correction with how sure it is.

    Attributes:
        correction: terms that the measurements do not decide are left as of a perfect device.
        decided: the terms that were fitted.
        covariance: (4, 4) of `TERMS`; terms that were not decided have what is known of such devices.
        distance_m: of the belt, straight ahead.
        depth_std_before_m, depth_std_m: of a depth at that distance, by what is known of such devices and now.
        figures: lengths before and after.
        sureness: what parts of the measurements tell, and all of them.
        missing: what would decide more, by term: `distance` (tape or larger ball), `wider` (a belt that fills more of
            the picture).
    """

    correction: DepthCorrection
    decided: tuple[str, ...]
    covariance: F64
    distance_m: float
    depth_std_before_m: float
    depth_std_m: float
    figures: tuple[Figure, ...]
    sureness: tuple[Sureness, ...]
    missing: Mapping[str, str]

    def std(self, term: str) -> float:
        """Return the standard deviation of a term."""
        place = TERMS.index(term)
        return float(np.sqrt(self.covariance[place, place]))
