"""Recordings written: MCAP, ROS 2 profile, depth raw, colour JPEG, zstd chunks."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType
from typing import Self

from fruitgui.errors import InputError, WorldError
from fruitgui.files import written_whole
from fruitgui.frame import Frame
from fruitgui.sensors.recordings.messages import CAMERA_INFO, COMPRESSED_IMAGE, IMAGE, Messages
from fruitgui.sensors.sensor import SensorInfo

CHUNK_BYTES = 4 * 1024 * 1024
_COLOR_INFO, _COLOR = "rgb/camera_info", "rgb/image_raw/compressed"
_DEPTH_INFO, _DEPTH = "depth_registered/camera_info", "depth_registered/image_raw"
_TYPES = {_COLOR_INFO: CAMERA_INFO, _COLOR: COMPRESSED_IMAGE, _DEPTH_INFO: CAMERA_INFO, _DEPTH: IMAGE}


class RecordingWriter:
    """Writes one recording; it appears under its name when it is closed, whole.

    Use as a context manager: an error inside leaves nothing behind. Depth is
    to be given as the device reads it, uncorrected.
    """

    def __init__(self, path: Path | str, infos: Iterable[SensorInfo]) -> None:
        from mcap.writer import CompressionType, Writer

        self.path = Path(path)
        self.frames_written = 0
        self._messages = Messages()
        self._stack = contextlib.ExitStack()
        self._beside = self._stack.enter_context(written_whole(self.path))
        self._file = self._stack.enter_context(self._beside.open("wb"))
        self._writer = Writer(self._file, chunk_size=CHUNK_BYTES, compression=CompressionType.ZSTD)
        self._writer.start(profile="ros2", library="fruitgui")
        self._schemas: dict[str, int] = {}
        self._channels: dict[tuple[str, str], int] = {}
        self._open = True
        for info in infos:
            self._add_sensor(info)

    @property
    def bytes_written(self) -> int:
        """How large the file is so far."""
        return self._file.tell()

    def _add_sensor(self, info: SensorInfo) -> None:
        self._writer.add_metadata(
            f"sensor/{info.sensor}",
            {"id": info.sensor, "make": info.make, "model": info.model, "serial": info.serial},
        )
        for part, type_name in _TYPES.items():
            self._channels[info.sensor, part] = self._writer.register_channel(
                f"/{info.sensor}/{part}", "cdr", self._schema(type_name)
            )

    def _schema(self, type_name: str) -> int:
        if type_name not in self._schemas:
            definition = self._messages.definition(type_name)
            self._schemas[type_name] = self._writer.register_schema(type_name, "ros2msg", definition)
        return self._schemas[type_name]

    def write(self, frame: Frame, log_time_ns: int | None = None) -> None:
        """Append a frame.

        Args:
            frame: of one of the sensors announced.
            log_time_ns: when it came, host clock; its own stamp where not given.

        Raises:
            InputError: of a sensor that was not announced, or with a time that no stamp can hold.
            WorldError: the disk is full or gone; nothing is left behind.
        """
        if (frame.sensor, _DEPTH) not in self._channels:
            raise InputError(
                "unknown_sensor", f"Sensor {frame.sensor} was not announced to the recording.",
                "Begin the recording with every sensor that it shall hold.", file=self.path,
            )  # fmt: skip
        stamp = _stamp_ns(frame.time_s)
        frame_id = f"{frame.sensor}_rgb_optical_frame"
        info = self._messages.camera_info(stamp, frame_id, frame.intrinsics)
        log_time = max(stamp if log_time_ns is None else log_time_ns, 0)
        for part, message in (
            (_COLOR_INFO, info),
            (_COLOR, self._messages.color(stamp, frame_id, frame.color)),
            (_DEPTH_INFO, info),
            (_DEPTH, self._messages.depth(stamp, frame_id, frame.depth_mm)),
        ):
            self._append(self._channels[frame.sensor, part], message, log_time, max(stamp, 0), frame.sequence)
        self.frames_written += 1

    def _append(self, channel: int, message: bytes, log_time: int, stamp: int, sequence: int) -> None:
        try:
            self._writer.add_message(channel, log_time, message, stamp, sequence)
        except OSError as error:
            self.discard()
            raise _cannot_write(self.path, error) from error

    def close(self) -> None:
        """Finish the file and give it its name. Raises `WorldError` where that fails."""
        if not self._open:
            return
        try:
            self._writer.finish()
            self._file.flush()
        except OSError as error:
            self.discard()
            raise _cannot_write(self.path, error) from error
        self._open = False
        self._stack.close()

    def discard(self) -> None:
        """Leave nothing behind."""
        if not self._open:
            return
        self._open = False
        with contextlib.suppress(_DiscardedError, WorldError), self._stack:
            raise _DiscardedError

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.close()
        else:
            self.discard()


class _DiscardedError(Exception):
    """Tells the file beside that it shall not take its name."""


def _stamp_ns(time_s: float) -> int:
    """Return whole nanoseconds of a float of seconds, so that dividing them again gives the same float."""
    if not (math.isfinite(time_s) and abs(time_s) < 2**31):
        raise InputError("bad_stamp", f"A frame's time {time_s} cannot be recorded.", "Check the sensor's clock.")
    seconds = math.floor(time_s)
    return seconds * 1_000_000_000 + round((time_s - seconds) * 1e9)


def _cannot_write(path: Path, error: OSError) -> WorldError:
    return WorldError(
        "cannot_write", f"Cannot write {path}: {error.strerror}.", "Check that the disk has room and is there.",
        file=path,
    )  # fmt: skip
