"""A recording written in parts, so that no file becomes too large, or too long, to be handled."""

from __future__ import annotations

import uuid
from collections import Counter, deque
from collections.abc import Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from pathlib import Path

from fruitgui.errors import InputError, WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.recordings.series import ABOUT, MOST_PARTS, Part, part_path
from fruitgui.sensors.recordings.writer import Here, RecordingWriter, stamp_ns
from fruitgui.sensors.sensor import SensorInfo


@dataclass(frozen=True, slots=True)
class Split:
    """When another part begins.

    Attributes:
        most_bytes: no part becomes larger; None for no limit.
        most_s: no part lasts longer, by the times at which frames came; None for no limit.
    """

    most_bytes: int | None = None
    most_s: float | None = None


class SeriesWriter:
    """Writes frames into one file after another; each is whole in itself. One thread calls.

    Args:
        path: of the first part; see `part_path` for the others.
        infos: of every sensor that it shall hold.
        split: when another part begins.
        hands: who packs, and who finishes a part while the next is being written; the calling thread unless given.

    Raises:
        InputError: a file lies where a part would.
        WorldError: nothing can be written there.
    """

    def __init__(
        self, path: Path, infos: Sequence[SensorInfo], split: Split | None = None, hands: Executor | None = None
    ) -> None:
        self._path = path
        self._infos = infos
        self._split = split or Split()
        self._hands = hands or Here()
        self._id = uuid.uuid4().hex
        self._finished: list[RecordingWriter] = []
        self._finishing: deque[tuple[RecordingWriter, Future[None]]] = deque()
        self._began_ns: int | None = None
        if self._split != Split():
            _check_free(path)
        self._part = self._begin(1)

    @property
    def parts(self) -> tuple[Path, ...]:
        """Every file that was begun."""
        return tuple(writer.path for writer in self._writers)

    @property
    def kept(self) -> tuple[Path, ...]:
        """The files that hold a frame."""
        return tuple(writer.path for writer in self._writers if writer.frames_stored.total())

    @property
    def frames_stored(self) -> Counter[str]:
        """Frames in the files, by sensor."""
        return sum((writer.frames_stored for writer in self._writers), Counter())

    @property
    def bytes_written(self) -> int:
        """How large the files are so far, together."""
        return sum(writer.bytes_written for writer in self._writers)

    @property
    def _writers(self) -> tuple[RecordingWriter, ...]:
        return (*self._finished, *(writer for writer, _ in self._finishing), self._part)

    def identify(self, infos: Sequence[SensorInfo]) -> None:
        """Say anew who the sensors are, as `RecordingWriter.identify`."""
        self._infos = infos
        self._part.identify(infos)

    def write(self, frame: Frame, log_time_ns: int | None = None) -> None:
        """Take a frame, as `RecordingWriter.write`."""
        came_ns = stamp_ns(frame.time_s) if log_time_ns is None else log_time_ns
        if self._began_ns is not None and self._is_over(frame, came_ns):
            self._begin_next()
        if self._began_ns is None:
            self._began_ns = came_ns
        self._part.write(frame, came_ns)

    def flush(self) -> None:
        """Store what has waited long enough, as `RecordingWriter.flush`."""
        self._part.flush()
        while self._finishing and self._finishing[0][1].done():
            self._take_finished()

    def close(self) -> None:
        """Store everything, and give every part its name.

        Raises:
            WorldError: that fails for some; everything else was done all the same.
        """
        try:
            self._part.store_all()
        finally:
            self.finish()

    def finish(self) -> None:
        """Give every part its name, with what is stored in it; a part without a frame leaves no file.

        Raises:
            WorldError: as `close`.
        """
        try:
            while self._finishing:
                self._take_finished()
        finally:
            if self._part.frames_stored.total():
                self._part.finish()
            else:
                self._part.discard()

    def _is_over(self, frame: Frame, came_ns: int) -> bool:
        most_bytes, most_s = self._split.most_bytes, self._split.most_s
        if most_s is not None and self._began_ns is not None and came_ns - self._began_ns >= most_s * 1e9:
            return True
        coming = frame.color.nbytes + frame.depth_mm.nbytes
        return most_bytes is not None and self._part.bytes_finished + coming > most_bytes

    def _begin(self, number: int) -> RecordingWriter:
        about = {ABOUT: Part(self._id, number).value()}
        return RecordingWriter(part_path(self._path, number), self._infos, self._hands, about)

    def _begin_next(self) -> None:
        number = len(self._writers) + 1
        if number > MOST_PARTS:
            raise WorldError(
                "too_many_parts", f"{self._path} has {MOST_PARTS} parts already.", "Let its parts be larger.",
                file=self._path,
            )  # fmt: skip
        following = self._begin(number)
        over, self._part, self._began_ns = self._part, following, None
        try:
            over.store_all()
        finally:
            self._finishing.append((over, self._hands.submit(over.finish)))

    def _take_finished(self) -> None:
        writer, finishing = self._finishing.popleft()
        self._finished.append(writer)
        finishing.result()


def _check_free(path: Path) -> None:
    taken = next(iter(sorted(path.parent.glob(f"{_escaped(path.stem)}_[0-9][0-9][0-9][0-9]{path.suffix}"))), None)
    if taken is not None:
        raise InputError(
            "parts_there", f"{taken} is there already, where a part of this recording would go.",
            "Give the recording another name, or move that file away.", file=taken,
        )  # fmt: skip


def _escaped(stem: str) -> str:
    import glob

    return glob.escape(stem)
