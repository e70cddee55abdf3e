"""Recordings written: MCAP, ROS 2 profile, depth raw, colour JPEG, zstd chunks."""

from __future__ import annotations

import math
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor, Future
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from fruitgui.errors import FruitguiError, InputError
from fruitgui.frame import Frame
from fruitgui.sensors.recordings.messages import Messages
from fruitgui.sensors.recordings.packing import DEPTH, TYPES, Chunk, Stamped, pack
from fruitgui.sensors.recordings.part_file import PartFile, cannot_finish, cannot_write
from fruitgui.sensors.sensor import SensorInfo

CHUNK_BYTES = 6 * 1024 * 1024
"""Pictures that are packed into one chunk: four captures of 640×480."""

CHUNK_S = 0.5
"""No frame waits longer for its chunk to fill: what was recorded is on the disk soon, however slow the sensors."""

WAITING_CHUNKS = 4
"""Chunks that may be in the making; with more, the next frame waits."""


class Here(Executor):
    """Does everything at once, on the thread that asks."""

    def submit(self, work: Callable[..., Any], /, *args: Any, **named: Any) -> Future[Any]:  # noqa: ANN401 - as in the base
        """Do it."""
        done: Future[Any] = Future()
        try:
            done.set_result(work(*args, **named))
        except FruitguiError as error:
            done.set_exception(error)
        return done


class RecordingWriter:
    """Writes one recording; it appears under its name when it is closed, whole.

    Until then it lies beside under an unfinished name, see `PartFile`, and is sound up to its last chunk, also after
    an error: it can be closed all the same. As a context manager an error inside leaves nothing behind. Depth is to be
    given as the device reads it, uncorrected. One thread calls.

    Args:
        path: of the recording.
        infos: of every sensor that it shall hold.
        hands: who packs; the calling thread unless given.
        about: named records of text that shall stand in it too.

    Raises:
        InputError, WorldError: see `PartFile`.
    """

    def __init__(
        self,
        path: Path | str,
        infos: Iterable[SensorInfo],
        hands: Executor | None = None,
        about: Mapping[str, Mapping[str, str]] | None = None,
    ) -> None:
        from fruitgui.sensors.recordings.mcap_output import McapOutput

        self.path = Path(path)
        self._messages = Messages()
        self._hands = hands or Here()
        self._batch: list[Stamped] = []
        self._batch_began_s = 0.0
        self._making: deque[tuple[Future[Chunk], int]] = deque()
        self._infos = {info.sensor: info for info in infos}
        self._about = dict(about or {})
        self._channels = {(sensor, part): 1 + n for n, (sensor, part) in enumerate(_parts(self._infos))}
        self._file = PartFile(self.path)
        self._output = McapOutput(self._file.raw)
        self._open = True

    @property
    def bytes_written(self) -> int:
        """How large the file is so far."""
        return self._output.size

    @property
    def bytes_finished(self) -> int:
        """How large the file would become if it were closed now, at most."""
        return self._output.size_finished + self._bytes_coming

    @property
    def _bytes_coming(self) -> int:
        """What is not in the file yet, unpacked: more than will be added."""
        return sum(one.raw_bytes for one in self._batch) + sum(raw_bytes for _, raw_bytes in self._making)

    @property
    def frames_stored(self) -> Counter[str]:
        """Frames in the file, by sensor."""
        counts = self._output.counts
        return Counter({sensor: counts[channel] for (sensor, part), channel in self._channels.items() if part == DEPTH})

    def identify(self, infos: Iterable[SensorInfo]) -> None:
        """Say anew who the sensors are: more may be known once they run. Without effect once a frame is stored."""
        self._infos |= {info.sensor: info for info in infos if info.sensor in self._infos}

    def write(self, frame: Frame, log_time_ns: int | None = None) -> None:
        """Take a frame; it is in the file within `CHUNK_S`, if `flush` is called in time.

        Args:
            frame: of one of the sensors announced.
            log_time_ns: when it came, host clock; its own stamp where not given.

        Raises:
            InputError: of a sensor that was not announced, or with a time that no stamp can hold.
            WorldError: the disk is full or gone; the frames that were not stored yet are lost.
        """
        if (frame.sensor, DEPTH) not in self._channels:
            raise InputError(
                "unknown_sensor", f"Sensor {frame.sensor} was not announced to the recording.",
                "Begin the recording with every sensor that it shall hold.", file=self.path,
                values={"sensor": frame.sensor},
            )  # fmt: skip
        stamp = stamp_ns(frame.time_s)
        if not self._batch:
            self._batch_began_s = time.monotonic()
        self._batch.append(Stamped(frame, stamp, max(stamp if log_time_ns is None else log_time_ns, 0)))
        self.flush()

    def flush(self) -> None:
        """Pack what has waited long enough, and store what is packed; to be called also while no frame comes.

        Raises:
            WorldError: as `write`.
        """
        full = sum(one.raw_bytes for one in self._batch) >= CHUNK_BYTES
        if self._batch and (full or time.monotonic() - self._batch_began_s >= CHUNK_S):
            self._pack()
        while self._making and (self._making[0][0].done() or len(self._making) > WAITING_CHUNKS):
            self._store()

    def _pack(self) -> None:
        batch, self._batch = self._batch, []
        raw_bytes = sum(one.raw_bytes for one in batch)
        self._making.append((self._hands.submit(pack, batch, self._channels, self._messages), raw_bytes))

    def _store(self) -> None:
        chunk = self._making.popleft()[0].result()
        try:
            self._begin()
            self._output.append(chunk)
        except OSError as error:
            self._let_go()
            raise cannot_write(self.path, error) from error

    def _begin(self) -> None:
        if not self._output.begun:
            self._output.begin(_definitions(self._messages, self._channels, self._infos.values(), self._about))

    def _let_go(self) -> None:
        """Forget what is not stored."""
        self._batch.clear()
        for making, _ in self._making:
            making.cancel()
        self._making.clear()

    def store_all(self) -> None:
        """Store everything that was given, and wait for it. Raises `WorldError` as `write`."""
        if self._batch:
            self._pack()
        while self._making:
            self._store()

    def close(self) -> None:
        """Finish the file and give it its name.

        Raises:
            WorldError: that fails; the file stays beside, sound as far as it was stored.
        """
        if self._open:
            self.store_all()
            self.finish()

    def finish(self) -> None:
        """Give what is stored its table of contents and its name; frames that are not stored are lost.

        Raises:
            WorldError: as `close`.
        """
        if not self._open:
            return
        self._let_go()
        try:
            self._begin()
            self._output.finish()
            self._file.keep()
        except OSError as error:
            self._file.leave()
            raise cannot_finish(self.path, error) from error
        self._open = False

    def discard(self) -> None:
        """Leave nothing behind."""
        if self._open:
            self._open = False
            self._let_go()
            self._file.discard()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                self.close()
        finally:
            self.discard()


def _parts(sensors: Iterable[str]) -> Iterable[tuple[str, str]]:
    return ((sensor, part) for sensor in sensors for part in TYPES)


def _definitions(
    messages: Messages,
    channels: Mapping[tuple[str, str], int],
    infos: Iterable[SensorInfo],
    about: Mapping[str, Mapping[str, str]],
) -> Any:  # noqa: ANN401 - loaded here, with the package that lays it out
    from mcap.records import Channel, Schema

    from fruitgui.sensors.recordings.mcap_output import Definitions

    numbers = {name: number for number, name in enumerate(dict.fromkeys(TYPES.values()), start=1)}
    schemas = [Schema(number, messages.definition(name), "ros2msg", name) for name, number in numbers.items()]
    who = {
        f"sensor/{info.sensor}": {
            "id": info.sensor, "make": info.make, "model": info.model, "serial": info.serial
        }
        for info in infos
    }  # fmt: skip
    return Definitions(
        schemas,
        [
            Channel(id=number, topic=f"/{sensor}/{part}", message_encoding="cdr", metadata={},
                    schema_id=numbers[TYPES[part]])
            for (sensor, part), number in channels.items()
        ],
        {**who, **about},
    )  # fmt: skip


def stamp_ns(time_s: float) -> int:
    """Return whole nanoseconds of a float of seconds, so that dividing them again gives the same float.

    Raises:
        InputError: no stamp can hold it.
    """
    if not (math.isfinite(time_s) and abs(time_s) < 2**31):
        raise InputError("bad_stamp", f"A frame's time {time_s} cannot be recorded.", "Check the sensor's clock.")
    seconds = math.floor(time_s)
    return seconds * 1_000_000_000 + round((time_s - seconds) * 1e9)
