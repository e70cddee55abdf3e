"""What the two processes say to each other; a frame's pictures lie in memory that both share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from fruitgui.errors import FruitguiError
from fruitgui.frame import Intrinsics
from fruitgui.sensors.feed import Arrival, Lit, Order, Room, SensorHealth
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station.live.intake import Intake
from fruitgui.station.live.state import Finished, LiveState, Preview
from fruitgui.station.model import Model
from fruitgui.station.station import Station


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """What a line is made of.

    Attributes:
        infos: the sensors. healths: how they are. station, model, intake: see `LiveLine`.
        memory: name of the memory that is shared. place_bytes: from one frame's place in it to the next.
    """

    infos: Mapping[str, SensorInfo]
    healths: tuple[SensorHealth, ...]
    station: Station
    model: Model | None
    intake: Intake
    memory: str
    place_bytes: int


# To the line.


@dataclass(frozen=True, slots=True)
class Given:
    """A frame to be followed.

    Attributes:
        place: of its pictures.
        sensor, sequence, time_s, intrinsics, felt_m_s2, clock_leaps: of the frame.
        arrived_s, lit: of its arrival.
        lot: into which fruit are counted from now on.
    """

    place: int
    sensor: str
    sequence: int
    time_s: float
    intrinsics: Intrinsics
    felt_m_s2: tuple[float, float, float] | None
    clock_leaps: int
    arrived_s: float
    lit: Lit
    lot: int | None


def given(arrival: Arrival, place: int, lot: int | None) -> Given:
    """Return the message that an arrival is, without its pictures."""
    frame = arrival.frame
    return Given(
        place, frame.sensor, frame.sequence, frame.time_s, frame.intrinsics, frame.felt_m_s2, frame.clock_leaps,
        arrival.arrived_s, arrival.lit, lot,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Healths:
    """How the sensors are."""

    sensors: tuple[SensorHealth, ...]


@dataclass(frozen=True, slots=True)
class NoMore:
    """No frame will come any more."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Follow what was given, and end by a time of the monotonic clock; `lot` as it was last."""

    until_s: float
    lot: int | None


# From the line.


@dataclass(frozen=True, slots=True, eq=False)
class Made:
    """The line is there and wants frames."""

    room: Room
    order: Order


@dataclass(frozen=True, slots=True, eq=False)
class NotMade:
    """There is no line."""

    why: FruitguiError


@dataclass(frozen=True, slots=True)
class Taken:
    """A place is free again."""

    place: int


@dataclass(frozen=True, slots=True)
class Shifted:
    """Clocks were put right, see `Subscription.shift`."""

    offsets_s: Mapping[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class Out:
    """A fruit that left, to be counted."""

    finished: Finished
    lot: int | None


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """How the line is, without what only the other process knows."""

    state: LiveState


@dataclass(frozen=True, slots=True, eq=False)
class Pictured:
    """New pictures, without their colours: the other process has them."""

    previews: tuple[Preview, ...]


@dataclass(frozen=True, slots=True)
class Ended:
    """The line has ended; whether all was followed and measured."""

    done: bool
