"""A Kinect v1 as a sensor."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Callable

import numpy as np

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.frame import U16, Frame
from fruitgui.sensors.kinect.cameras import HEIGHT, NOMINAL_COLOR, WIDTH, cameras_of
from fruitgui.sensors.kinect.capture import Captures
from fruitgui.sensors.kinect.depth_table import depth_table, millimetres
from fruitgui.sensors.kinect.device import Device, Hear
from fruitgui.sensors.kinect.factory import Factory
from fruitgui.sensors.kinect.motor import Led, Motor
from fruitgui.sensors.kinect.packets import Stream
from fruitgui.sensors.kinect.session import LeftBehind, Session
from fruitgui.sensors.registration import Registration
from fruitgui.sensors.sensor import ColorLock, Projector, SensorInfo, SensorTimeoutError

RATE_HZ = 30.0
FELT_EVERY_S = 1.0
MakeDevice = Callable[[Hear], Device]


class KinectSensor:
    """One Kinect; follows the `Sensor` protocol. Constructing touches no device.

    Frames have the host's monotonic clock, to some milliseconds; one of which
    packets were lost is marked as damaged. Until it is open, its model is not
    known and its cameras are a usual Kinect's.

    Args:
        serial: of the device.
        device: makes it, not yet open, given who hears of its pictures.
        left: sessions that hang, of all sensors of the driver.
        motor: makes its motor, not yet open, for its light and its accelerometer; None where it has none.
    """

    def __init__(
        self, serial: str, device: MakeDevice, left: LeftBehind, motor: Callable[[], Motor] | None = None
    ) -> None:
        self._serial = serial
        self._make_device = device
        self._left = left
        self._make_motor = motor
        self._motor: Motor | None = None
        self._felt_m_s2: tuple[float, float, float] | None = None
        self._felt_s = -math.inf
        self._name = "kinect_" + re.sub(r"\W", "_", serial, flags=re.ASCII)
        self._model, self._firmware = "Kinect v1", ""
        self._color = NOMINAL_COLOR
        self._table: U16 | None = None
        self._registration: Registration | None = None
        self._captures = Captures()
        self._device: Device | None = None
        self._session: Session | None = None
        self._shining = True

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return SensorInfo(
            self._name, "Microsoft", self._model, self._serial, self._color, RATE_HZ, Projector.SWITCHED,
            ColorLock.LOCKABLE, self._firmware,
        )  # fmt: skip

    def open(self) -> None:
        """Take the device.

        Raises:
            WorldError: it is not there, may not be opened, is used already, or does not answer.
        """
        self.close()
        self._left.check(self._serial)
        captures = Captures()
        device = self._make_device(captures.hear)
        session = Session(device, self._serial, lambda: captures.end(session.failure))
        self._session, self._device, self._captures = session, device, captures
        try:
            opened = session.open()
        except FruitguiError:
            self.close()
            raise
        self._model, self._firmware = opened.camera.model.name, opened.camera.firmware
        self._take(opened.factory)
        if opened.camera.model.has_motor and self._make_motor is not None:
            self._motor = self._make_motor()
            self._motor.open()

    def start(self) -> None:
        """Begin to capture, in the dark where the projector was told to be dark.

        Raises:
            WorldError: it is not open, is gone, does not answer, or its USB controller has no room left.
        """
        self._light(Led.GREEN)
        self._switch(Stream.VIDEO, on=True)
        if self._shining:
            self._switch(Stream.DEPTH, on=True)

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame.

        Raises:
            SensorTimeoutError: none came in time.
            WorldError: it is not open, or is gone.
        """
        if self._table is None or self._registration is None or self._session is None:
            raise _not_open(self._serial)
        capture = self._captures.next(timeout_s)
        if capture is None:
            raise SensorTimeoutError(self._name, timeout_s, self._captures.heard_s)
        pair = capture.pair
        self._feel()
        depth_mm = self._registration.apply(millimetres(pair.depth.raw, self._table))
        return Frame(
            self._name,
            capture.sequence,
            capture.time_s,
            pair.color.color,
            depth_mm,
            self._color,
            damaged=not pair.whole,
            felt_m_s2=self._felt_m_s2,
            clock_leaps=capture.clock_leaps,
            time_sure=capture.time_sure,
        )

    def projector(self, on: bool) -> None:
        """Switch the projector, which shines while depth streams; colour goes on.

        Raises:
            WorldError: it is not open or does not obey; then it may shine or not.
        """
        self._shining = on
        if self._session is not None and self._session.failure is None:
            self._switch(Stream.DEPTH, on)

    def lock_color(self, on: bool) -> bool:
        """Hold exposure and white balance as they are, or let them follow the light; tell whether it could be done.

        Raises:
            WorldError: it is not open or does not answer.
        """
        session, device = self._opened()
        return session.ask(lambda: device.lock_color(on))

    def stop(self) -> None:
        """End capturing; the projector is dark then, where the device still answers."""
        if self._session is None or self._session.failure is not None:
            return
        self._light(Led.BLINKING_GREEN)
        session, device = self._opened()
        session.ask(device.stop)
        self._captures.begin_anew()

    def close(self) -> None:
        """Give the device back within two seconds; a thread that hangs in the library is left behind."""
        if self._motor is not None:
            self._motor.close()
            self._motor = None
        if self._session is not None and not self._session.close():
            self._left.add(self._session)
        self._session, self._device = None, None
        self._captures.begin_anew()  # six megabytes that nobody will read

    def _light(self, led: Led) -> None:
        """Show whether it is in use, as far as it has a light."""
        if self._motor is not None:
            self._motor.light(led)

    def _feel(self) -> None:
        if self._motor is not None and time.monotonic() - self._felt_s > FELT_EVERY_S:
            self._felt_s = time.monotonic()
            self._felt_m_s2 = self._motor.felt_m_s2()

    def _take(self, factory: Factory) -> None:
        self._table = depth_table(factory.zero_plane)
        self._registration = cameras_of(factory).registration
        self._registration.apply(
            np.full((HEIGHT, WIDTH), 1000, np.uint16)
        )  # its tables are made now, for no frame to wait
        self._color = self._registration.color

    def _switch(self, stream: Stream, on: bool) -> None:
        session, device = self._opened()
        session.ask(lambda: device.switch(stream, on))
        if stream is Stream.DEPTH:
            self._captures.begin_anew()

    def _opened(self) -> tuple[Session, Device]:
        if self._session is None or self._device is None:
            raise _not_open(self._serial)
        return self._session, self._device


def _not_open(serial: str) -> WorldError:
    return WorldError("sensor_not_open", f"The Kinect {serial} is not open.", "Open it first.")
