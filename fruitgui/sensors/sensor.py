"""The one protocol that every sensor follows. A driver fills a frame; nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from fruitgui.errors import WorldError
from fruitgui.frame import Frame, Intrinsics


class Projector(StrEnum):
    """What a sensor's own light does to other sensors that see the same place.

    Attributes:
        HARMLESS: it has none, or one that others do not mind.
        SWITCHED: it blinds others and can be switched: such sensors take turns.
        FIXED: it blinds others and cannot be switched.
    """

    HARMLESS = "harmless"
    SWITCHED = "switched"
    FIXED = "fixed"


class ColorLock(StrEnum):
    """Whether exposure and white balance stay as they are.

    Attributes:
        UNKNOWN: the driver cannot tell.
        AUTOMATIC: they follow the light, and cannot be held.
        LOCKABLE: they follow the light now, and can be held.
        LOCKED: they are held.
    """

    UNKNOWN = "unknown"
    AUTOMATIC = "automatic"
    LOCKABLE = "lockable"
    LOCKED = "locked"


@dataclass(frozen=True, slots=True)
class SensorInfo:
    """Who a sensor is.

    Attributes:
        sensor: the id that a person gave, ROS-safe.
        make, model, serial: of the device; empty where unknown.
        intrinsics: of the colour camera, to which depth is registered.
        rate_hz: nominal frame rate, when not taking turns.
        projector: whether it has to take turns with others.
        color_lock: whether exposure and white balance stay as they are; may change while it runs.
        firmware: of the device, as it says; empty where it does not, or not yet.
    """

    sensor: str
    make: str
    model: str
    serial: str
    intrinsics: Intrinsics
    rate_hz: float
    projector: Projector = Projector.HARMLESS
    color_lock: ColorLock = ColorLock.UNKNOWN
    firmware: str = ""


class SensorTimeoutError(WorldError):
    """No frame came within the time allowed.

    Attributes:
        heard_s: when anything last came of the device, by the host's monotonic clock, where its driver can tell: of one
            whose projector is dark, colour still comes.
    """

    def __init__(self, sensor: str, timeout_s: float, heard_s: float | None = None) -> None:
        super().__init__(
            "sensor_silent",
            f"Sensor {sensor} gave no frame within {timeout_s:g} s.",
            "Check its cable and power; it is opened again by itself when it returns.",
            values={"sensor": sensor},
        )
        self.heard_s = heard_s


class EndOfStreamError(WorldError):
    """A sensor that plays something finite has given its last frame."""

    def __init__(self, sensor: str) -> None:
        super().__init__(
            "end_of_stream",
            f"Sensor {sensor} has no more frames.",
            "Start it again to replay.",
            values={"sensor": sensor},
        )


class Sensor(Protocol):
    """One RGB-D camera. Not thread-safe: one owner calls it.

    The order is open, start, read …, stop, close; stop and close may be called
    at any time and any number of times. A projector that is switched is told
    what to be between open and start as well as later; untold, `start` turns
    it on. After stop it is dark.
    """

    @property
    def info(self) -> SensorInfo:
        """Who this is; valid from construction on."""

    def open(self) -> None:
        """Take the device. Raises `WorldError` where it cannot be had."""

    def start(self) -> None:
        """Begin to capture."""

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame.

        Raises:
            SensorTimeoutError: none came in time.
            EndOfStreamError: none will come.
        """

    def projector(self, on: bool) -> None:
        """Switch the projector, where it can be switched; returns once it is so. While it is dark no frames come."""

    def stop(self) -> None:
        """End capturing."""

    def close(self) -> None:
        """Give the device back."""
