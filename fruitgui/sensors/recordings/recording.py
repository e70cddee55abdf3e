"""A recording of one or several sensors, read from front to back."""

from __future__ import annotations

from collections.abc import Collection, Generator, Iterator, Mapping, Sequence
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.sensors.ahead import ReadAhead
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.recordings.chained import Chained
from fruitgui.sensors.recordings.container import open_container
from fruitgui.sensors.recordings.decoding import Decoder, UnusableSensorError, decoder_of
from fruitgui.sensors.recordings.merge import Merge
from fruitgui.sensors.recordings.pairing import Pair
from fruitgui.sensors.recordings.raw import Container, MalformedError
from fruitgui.sensors.recordings.series import parts_after
from fruitgui.sensors.recordings.survey import Survey, survey
from fruitgui.sensors.recordings.tally import Tally
from fruitgui.sensors.recordings.topics import SensorTopics, find_sensors, sensor_of
from fruitgui.sensors.recordings.wire import stamp_ns
from fruitgui.sensors.sensor import SensorInfo

MAX_SENSORS = 64
MAX_FAULTS_TOLD = 8


class Recording:
    """The frames of a recording. Made by `open_recording`.

    Attributes:
        path: of the file.
        sensors: who the sensors are, by id; all of these are read.
        warnings: what is not as it should be, in words; more is added while frames are read.
        tally: frames read and left out per sensor, of the latest reading.
    """

    def __init__(
        self,
        path: Path,
        container: Container,
        decoders: Mapping[str, Decoder],
        topics: Mapping[str, SensorTopics],
        sensors: Mapping[str, SensorInfo],
        clock_offsets_s: Mapping[str, float],
        warnings: Collection[str],
        unstamped: Collection[str],
        known: Collection[str],
    ) -> None:
        self.path = path
        self.sensors = dict(sensors)
        self.tally = Tally()
        self._container = container
        self._decoders = decoders
        self._clock_offsets_s = dict(clock_offsets_s)
        self._opening_warnings = tuple(warnings)
        self._unstamped = frozenset(unstamped)
        self._known = frozenset(known)
        self._roles = {topics[sensor].color: (sensor, False) for sensor in decoders}
        self._roles |= {topics[sensor].depth: (sensor, True) for sensor in decoders}

    @property
    def warnings(self) -> list[str]:
        """Everything that is not as it should be, in words."""
        return [*self._opening_warnings, *self.tally.warnings(self.path)]

    @property
    def share_read(self) -> float:
        """How much of the file the latest reading has come past, 0–1."""
        return self._container.bytes_read / max(self._container.size, 1)

    def frames(
        self,
        *,
        clock_offsets: Mapping[str, float] | None = None,
        corrections: Mapping[str, DepthCorrection] | None = None,
        ahead: int = 0,
    ) -> Generator[tuple[float, Frame], None, None]:
        """Yield (time in the reference sensor's clock, frame) of all sensors in the order of that time.

        Each call reads the file anew; nothing is held but the last seconds.
        Frames of one sensor are always in order; those of different sensors
        are as long as their clocks, offsets applied, differ by less than 2 s.

        Args:
            clock_offsets: seconds added to a sensor's stamps; None keeps those given on opening.
            corrections: of each sensor's depth, applied once, here.
            ahead: how many frames a thread of its own decodes ahead; 0 for none. Close the generator, or read to
                the end, to end the thread.

        Raises:
            InputError: at the end, where not one frame could be read.
        """
        frames = self._frames(clock_offsets, corrections or {})
        if not ahead:
            yield from frames
            return
        with ReadAhead(frames, ahead) as read_ahead:
            yield from read_ahead

    def _frames(
        self, clock_offsets: Mapping[str, float] | None, corrections: Mapping[str, DepthCorrection]
    ) -> Generator[tuple[float, Frame], None, None]:
        offsets_s = self._clock_offsets_s if clock_offsets is None else clock_offsets
        merge = Merge({sensor: round(seconds * 1e9) for sensor, seconds in offsets_s.items()})
        self.tally = tally = Tally()
        for sensor, pair in self._pairs(merge, tally):
            try:
                frame = self._decoders[sensor].decode(pair, tally.frames.get(sensor, 0), corrections.get(sensor))
            except MalformedError as error:
                tally.undecodable(sensor, str(error))
                continue
            tally.read(sensor, pair.time_ns)
            yield frame.time_s + offsets_s.get(sensor, 0.0), frame
        for sensor in self._decoders:
            tally.leave_out(sensor, merge.dropped(sensor))
        tally.soundness = self._container.soundness
        if not tally.frames:
            raise self._no_frame()

    def _pairs(self, merge: Merge, tally: Tally) -> Iterator[tuple[str, Pair]]:
        def wanted(topic: str) -> bool:
            sensor = sensor_of(topic)
            if sensor is not None and sensor not in self._known:
                tally.too_late.add(sensor)
            return topic in self._roles

        for message in self._container.messages(wanted):
            sensor, depth = self._roles[message.topic]
            try:
                self._decoders[sensor].check_bytes(len(message.data), depth=depth)
                stamp = message.log_time_ns if sensor in self._unstamped else stamp_ns(message)
            except MalformedError as error:
                if depth:
                    tally.undecodable(sensor, str(error))
                continue
            yield from merge.add(sensor, stamp, message, depth=depth)
        yield from merge.finish()

    def _no_frame(self) -> InputError:
        reasons = "; ".join(self.warnings) or "colour and depth never come together"
        return InputError(
            "no_frame",
            f"Not one frame of {self.path} can be read: {reasons}",
            "Record again, or name another file.",
            file=self.path,
        )


def open_recording(
    path: Path | str,
    *,
    topics: Mapping[str, SensorTopics] | None = None,
    sensors: Collection[str] = (),
    clock_offsets: Mapping[str, float] | None = None,
    following: Sequence[Path] = (),
) -> Recording:
    """Open a recording and see which sensors are in it.

    Args:
        path: an MCAP file or a ROS 1 bag.
        topics: topics named by a person, by sensor; see `parse_topics`.
        sensors: ids of the sensors that are wanted; empty for all.
        clock_offsets: seconds added to a sensor's stamps.
        following: further parts of the same recording, read after it; see `parts_after`.

    Raises:
        InputError: not a recording, or no sensor of it can be read.
    """
    path = Path(path)
    named = dict(topics or {})
    container: Container = Chained((path, *following)) if following else open_container(path)
    seen = survey(container, named, sensors)
    known = find_sensors(seen.types, named)
    try:
        found = _wanted_sensors(path, known, sensors)
        decoders, faults = _decoders(found, seen)
        if not decoders:
            raise faults[0].as_input_error(str(path))
    except InputError as error:
        raise _or_damage(error, path, container) from error
    if len(decoders) > MAX_SENSORS:
        raise InputError(
            "too_many_sensors",
            f"{path} holds {len(decoders)} sensors; at most {MAX_SENSORS} can be read together.",
            "Name those that are wanted with --sensors.",
            file=path,
        )
    infos = {sensor: _info(decoder, found[sensor], container, seen) for sensor, decoder in decoders.items()}
    unstamped = [sensor for sensor in decoders if seen.unstamped(found[sensor].depth)]
    warnings = _warnings(path, faults, unstamped)
    if not following and (more := parts_after(path)):
        warnings.append(
            f"{path.name} is a part of a recording; it goes on in {more[0].name}"
            f"{f' to {more[-1].name}' if len(more) > 1 else ''}, which is not read. --parts reads all of it."
        )
    return Recording(path, container, decoders, found, infos, clock_offsets or {}, warnings, unstamped, known)


def _or_damage(error: InputError, path: Path, container: Container) -> InputError:
    """Return why no sensor can be read; damage of the file is the likelier cause where there is some."""
    damage = Tally(soundness=container.soundness).warnings(path)
    if not damage:
        return error
    what = f"{error.what} {' '.join(damage)}"
    return InputError(error.code, what, "Copy the file again, or record again.", file=path, where=error.where)


def _warnings(path: Path, faults: Sequence[UnusableSensorError], unstamped: Sequence[str]) -> list[str]:
    told = [f"{path.name}: {fault.what} It is left out. {fault.remedy}" for fault in faults[:MAX_FAULTS_TOLD]]
    if len(faults) > len(told):
        told.append(f"{path.name}: {len(faults) - len(told)} more sensors are left out for reasons like these.")
    told += [f"{path.name}: {sensor} stamps every frame 0; the times of recording stand in." for sensor in unstamped]
    return told


def _wanted_sensors(path: Path, found: Mapping[str, SensorTopics], wanted: Collection[str]) -> dict[str, SensorTopics]:
    if not found:
        raise InputError(
            "no_sensor",
            f"{path} holds no sensor whose topics are known.",
            "Name its topics with --topics S:rgb=/…,info=/…,depth=/….",
            file=path,
        )
    missing = [sensor for sensor in wanted if sensor not in found]
    if missing:
        raise InputError(
            "unknown_sensor",
            f"{path} holds no sensor {missing[0]}; it holds {', '.join(sorted(found)[:8])}.",
            "Name sensors of the recording with --sensors.",
            values={"sensor": missing[0]},
            file=path,
            where="--sensors",
        )
    chosen = {sensor: topics for sensor, topics in found.items() if not wanted or sensor in wanted}
    return dict(sorted(chosen.items()))


def _decoders(found: Mapping[str, SensorTopics], seen: Survey) -> tuple[dict[str, Decoder], list[UnusableSensorError]]:
    decoders, faults = {}, []
    for sensor, topics in found.items():
        try:
            decoders[sensor] = decoder_of(sensor, topics, seen)
        except UnusableSensorError as fault:
            faults.append(fault)
    return decoders, faults


def _info(decoder: Decoder, topics: SensorTopics, container: Container, seen: Survey) -> SensorInfo:
    said = container.metadata.get(f"sensor/{decoder.sensor}", {})
    return SensorInfo(
        decoder.sensor,
        said.get("make", ""),
        said.get("model", ""),
        said.get("serial", ""),
        decoder.intrinsics,
        seen.rate_hz(topics.depth),
    )
