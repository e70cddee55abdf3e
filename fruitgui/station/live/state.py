"""What a screen draws of the running line: frozen records, the newest wins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from fruitgui.classification.evidence import Evidence
from fruitgui.frame import F32, F64, U8
from fruitgui.measurement.fruit import Quantity
from fruitgui.sensors.feed import SensorHealth
from fruitgui.station.fruit import Fruit
from fruitgui.station.live.blind import Blind
from fruitgui.station.sink import CountedFruit, Crop
from fruitgui.station.waiting import SinkState


class Phase(StrEnum):
    """What the line is doing; `ended`: its recordings are over and everything is counted."""

    STOPPED = "stopped"
    RUNNING = "running"
    STOPPING = "stopping"
    ENDED = "ended"


@dataclass(frozen=True, slots=True)
class LiveWarning:
    """Something that a person should know.

    Attributes:
        code: a stable word, such as `calibration_stale`; `gui/health.py` says each in the operator's language.
        text: in words.
        sensors: whom it concerns.
        count: how often it happened.
    """

    code: str
    text: str
    sensors: tuple[str, ...] = ()
    count: int = 1


@dataclass(frozen=True, slots=True)
class Spread:
    """The ellipse that holds a place with 95 %: centre, half axes, and the first axis's angle from x, radians."""

    x: float
    y: float
    major: float
    minor: float
    angle_rad: float


@dataclass(frozen=True, slots=True)
class Opinion:
    """What a fruit in view seems to be so far.

    Attributes:
        kind, probability: as the model says now; `unknown` without a model.
        volume_m3: as measured so far.
        views: that this rests on.
    """

    kind: str
    probability: float
    volume_m3: Quantity
    views: int


@dataclass(frozen=True, slots=True, eq=False)
class TrackNow:
    """A fruit in view.

    Attributes:
        track: its number.
        position_m: (3,) centre of volume, reference frame. covariance_m2: (3, 3) of it.
        views: how often it was seen. whole: how often whole.
        place_m: (2,) on the belt from above, x along its motion.
        spread: of the place, metres.
        trail_m: (M, 2) where it was on the belt from above, the oldest first.
        footprint_m: (K, 2) outline of what was seen of it, on the belt from above, carried along since.
        opinion: None while too little was seen.
    """

    track: int
    position_m: F64
    covariance_m2: F64
    views: int
    whole: int
    place_m: F64
    spread: Spread
    trail_m: F64
    footprint_m: F64
    opinion: Opinion | None


@dataclass(frozen=True, slots=True, eq=False)
class Pictured:
    """A fruit in one sensor's picture, pixels of the colour image.

    Attributes:
        track: its number.
        outline_px: (K, 2), none where this frame did not show it.
        spread: of its centre.
        trail_px: (M, 2) where its centre was, the oldest first.
        opinion: None while too little was seen.
    """

    track: int
    outline_px: F32
    spread: Spread | None
    trail_px: F64
    opinion: Opinion | None


@dataclass(frozen=True, slots=True, eq=False)
class Preview:
    """The newest picture of one sensor that the line has followed.

    Attributes:
        sensor: its id in the feed. station_id: in the station.
        sequence, time_s: of the frame; time in the sensor's own clock.
        color: (h, w, 3) uint8 RGB, the frame's own: not to be written.
        fruit: in it.
        arrived_s: when the frame came, the host's monotonic clock.
    """

    sensor: str
    station_id: str
    sequence: int
    time_s: float
    color: U8
    fruit: tuple[Pictured, ...]
    arrived_s: float


@dataclass(frozen=True, slots=True)
class Spot:
    """Where one view shows a fruit: a point on it in the colour image, and how far from there it surely still is it.

    `sensor` is the station's id; `time_s` is of the frame, in the sensor's own clock.
    """

    sensor: str
    time_s: float
    u_px: float
    v_px: float
    radius_px: float


@dataclass(frozen=True, slots=True, eq=False)
class Finished:
    """A fruit that has left.

    Attributes:
        fruit: as the line gave it.
        crops: its pictures, the best of each sensor.
        evidence: what its kind was decided on: what teaching it needs.
        sensors: that saw it, the station's ids.
        spots: where each of its views shows it, in order of time.
    """

    fruit: Fruit
    crops: tuple[Crop, ...]
    evidence: Evidence
    sensors: tuple[str, ...]
    spots: tuple[Spot, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class LiveState:
    """The running line at one moment.

    Attributes:
        phase: what the line is doing.
        lot: into which fruit are counted; None while they pass uncounted (paused, or between lots).
        time_s: of the last observation, reference clock; None before the first.
        counted: fruit since the start that are durable, whatever the lot. passed: those that none was to count.
        tracks: in view now.
        last: the last fruit counted, the newest first; with their pictures.
        health: of each sensor.
        footprints_m: by station id, the (K, 2) polygon that a sensor sees, on the belt from above.
        belt_velocity_m_s: (3,) reference frame; None while the fruit have not shown it.
        frames: followed since the start.
        latency_s: from a frame's arrival until it was followed, median of the last ones.
        backlog: frames that wait. waiting_fruit: fruit that wait to be measured or kept.
        dropped: frames by sensor that the line had no time for. skipped: frames that could not be used.
        blind: what of the belt nobody sees now; None while every sensor is there.
        sparse: likewise what nobody sees often enough; None while every sensor that is there gives enough pictures.
        sink: how the store fares.
        warnings: what a person should know.
    """

    phase: Phase
    lot: int | None = None
    time_s: float | None = None
    counted: int = 0
    passed: int = 0
    tracks: tuple[TrackNow, ...] = ()
    last: tuple[tuple[CountedFruit, Finished], ...] = ()
    health: tuple[SensorHealth, ...] = ()
    footprints_m: Mapping[str, F64] = field(default_factory=dict)
    belt_velocity_m_s: F64 | None = None
    frames: int = 0
    latency_s: float = 0.0
    backlog: int = 0
    waiting_fruit: int = 0
    dropped: Mapping[str, int] = field(default_factory=dict)
    skipped: int = 0
    blind: Blind | None = None
    sparse: Blind | None = None
    sink: SinkState = SinkState()  # noqa: RUF009 - frozen
    warnings: tuple[LiveWarning, ...] = ()
