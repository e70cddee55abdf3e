"""A recorded sensor that behaves like a real one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.sensors.recordings import Recording, open_recording
from fruitgui.sensors.sensor import EndOfStreamError, SensorInfo


class PlaybackSensor:
    """Plays one sensor of a recording as fast as it is read; follows the `Sensor` protocol.

    Starting again plays from the beginning. The frames keep their stamps.
    """

    def __init__(self, path: Path | str, sensor: str, *, name: str | None = None) -> None:
        """Look up the sensor.

        Args:
            path: of the recording.
            sensor: its id in the recording.
            name: the id that its frames shall carry; that of the recording where not given.

        Raises:
            InputError: no such recording, or no such sensor in it.
        """
        self._recording: Recording = open_recording(path, sensors=[sensor])
        self._recorded_as = sensor
        if sensor not in self._recording.sensors:
            raise InputError(
                "unusable_sensor", "; ".join(self._recording.warnings), "Name a sensor that can be read.", file=path
            )
        self._info = replace(self._recording.sensors[sensor], sensor=name or sensor)
        self._frames: Iterator[tuple[float, Frame]] | None = None

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return self._info

    @property
    def recording(self) -> Recording:
        """The recording, with its warnings and counts."""
        return self._recording

    def open(self) -> None:
        """Do nothing: there is no device to take."""

    def start(self) -> None:
        """Play from the beginning."""
        self._frames = iter(self._recording.frames())

    def read(self, timeout_s: float) -> Frame:  # noqa: ARG002 - a file never keeps anyone waiting
        """Return the next frame.

        Raises:
            EndOfStreamError: the recording is at its end, or was not started.
            InputError: not one frame could be read.
        """
        if self._frames is None:
            raise EndOfStreamError(self._info.sensor)
        _, frame = next(self._frames, (0.0, None))
        if frame is None:
            self.stop()
            raise EndOfStreamError(self._info.sensor)
        return frame if frame.sensor == self._info.sensor else replace(frame, sensor=self._info.sensor)

    def projector(self, on: bool) -> None:
        """Do nothing: what was recorded was lit as it was."""

    def stop(self) -> None:
        """End playing."""
        self._frames = None

    def close(self) -> None:
        """End playing."""
        self.stop()


def playback_sensors(path: Path | str) -> list[PlaybackSensor]:
    """Return a sensor for each that a recording holds. Raises `InputError`."""
    return [PlaybackSensor(path, sensor) for sensor in open_recording(path).sensors]
