"""Recording from running sensors: nothing is lost unsaid, and whatever ends it, what was recorded is whole."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from fruitgui.errors import CancelledByUserError, InputError, WorldError
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.recordings import Split, open_recording, parts_after
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station import record_job
from fruitgui.station.connection import ConnectedSensor, Connection
from fruitgui.station.devices import Known, known_by_workspace, named_by_serial, only
from fruitgui.station.record_job import record_feed
from fruitgui.station.record_state import Ending, Recorded, RecordPlan, RecordState
from fruitgui.station.workspace import open_workspace
from tests.unit.sensors.scripted import ScriptedSensor, gone, small_frame, until

pytestmark = pytest.mark.usefixtures("no_leaked_threads")

GB = 10**9


@dataclass
class Disk:
    """A disk of which a test says how much is free."""

    free: int = 100 * GB


@contextmanager
def running(*sensors: ScriptedSensor) -> Iterator[Feed]:
    feed = Feed(sensors)
    feed.start()
    try:
        yield feed
    finally:
        assert feed.stop() == ()


class Beside:
    """A recording on a thread of its own, as the window has it."""

    def __init__(self, feed: Feed, plan: RecordPlan, disk: Disk | None = None) -> None:
        self.states: list[RecordState] = []
        self.stop = threading.Event()
        self._outcome: list[Recorded | BaseException] = []
        self._job = lambda: record_feed(feed, plan, self.states.append, self.stop.is_set, lambda _: disk or Disk())
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self) -> None:
        try:
            self._outcome.append(self._job())
        except BaseException as error:  # noqa: BLE001 - told below
            self._outcome.append(error)

    def taken(self) -> int:
        return sum(self.states[-1].frames.values()) if self.states else 0

    def end(self) -> Recorded:
        self._thread.join(30.0)
        (outcome,) = self._outcome
        if isinstance(outcome, BaseException):
            raise outcome
        return outcome


def sequences(*paths: Path) -> dict[str, list[int]]:
    """Return the numbers of each sensor's frames by their stamps: `small_frame` stamps a tenth of its number."""
    told: dict[str, list[int]] = {}
    for path in paths:
        for _, frame in open_recording(path).frames():
            told.setdefault(frame.sensor, []).append(round(10 * frame.time_s))
    return told


def scripted(*names: str) -> list[ScriptedSensor]:
    return [ScriptedSensor(name) for name in names]


def give(sensors: Sequence[ScriptedSensor], numbers: Sequence[int]) -> None:
    for number in numbers:
        for sensor in sensors:
            sensor.give(small_frame(sensor.info.sensor, number))


def wait(true: Callable[[], bool]) -> None:
    until(true, within_s=30.0)


def test_everything_that_comes_is_in_the_file_until_it_is_stopped(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    sensors = scripted("k1", "k2")
    with running(*sensors) as feed:
        beside = Beside(feed, RecordPlan(path))
        wait(lambda: bool(beside.states))
        give(sensors, range(40))
        wait(lambda: beside.taken() == 80)
        beside.stop.set()
        done = beside.end()
    assert done.ended is Ending.STOPPED
    assert done.frames == {"k1": 40, "k2": 40}
    assert done.warnings() == []
    assert done.missed == {"k1": 0, "k2": 0}
    assert sequences(path) == {"k1": list(range(40)), "k2": list(range(40))}
    assert list(tmp_path.iterdir()) == [path]
    infos = open_recording(path).sensors
    assert [(info.make, info.model, info.serial) for info in infos.values()] == [
        ("test", "scripted", "S-k1"), ("test", "scripted", "S-k2")
    ]  # fmt: skip
    assert done.value()["frames"] == {"k1": 40, "k2": 40}
    assert done.line().startswith(f"{path}: 80 frames over")


def test_it_lasts_as_long_as_was_asked_from_the_first_frame_on(tmp_path: Path) -> None:
    (sensor,) = scripted("k1")
    with running(sensor) as feed:
        beside = Beside(feed, RecordPlan(tmp_path / "r.mcap", seconds=1.5))
        wait(lambda: bool(beside.states))
        time.sleep(0.6)  # nothing came yet: this time does not count
        for number in range(10_000):
            give([sensor], [number])
            if not beside._thread.is_alive():
                break
            time.sleep(0.01)
        done = beside.end()
    assert done.ended is Ending.DONE
    assert done.frames["k1"] > 1
    assert done.seconds < 1.5
    assert sequences(tmp_path / "r.mcap")["k1"] == list(range(done.frames["k1"]))
    assert beside.states[-1].share <= 1.0


def test_time_goes_on_where_nothing_comes_any_more(tmp_path: Path) -> None:
    (sensor,) = scripted("k1")
    with running(sensor) as feed:
        beside = Beside(feed, RecordPlan(tmp_path / "r.mcap", seconds=0.4))
        wait(lambda: bool(beside.states))
        give([sensor], [0])
        done = beside.end()
    assert (done.ended, done.frames) == (Ending.DONE, {"k1": 1})


def test_a_sensor_that_dies_is_said_and_the_others_go_on(tmp_path: Path) -> None:
    one, other = scripted("k1", "k2")
    with running(one, other) as feed:
        beside = Beside(feed, RecordPlan(tmp_path / "r.mcap"))
        wait(lambda: bool(beside.states))
        give([one, other], range(3))
        other.give(gone("k2"))
        wait(lambda: beside.states[-1].silent == ("k2",))
        give([one], range(3, 9))
        other.give(*[small_frame("k2", number) for number in range(20, 23)])
        wait(lambda: beside.states[-1].silent == ())
        give([one], range(9, 12))
        one.give(gone("k1"))
        wait(lambda: beside.states[-1].silent == ("k1",))
        wait(lambda: beside.taken() == 18)
        beside.stop.set()
        done = beside.end()
    assert done.frames == {"k1": 12, "k2": 6}
    assert [(silence.sensor, silence.until_s is None) for silence in done.silences] == [("k2", False), ("k1", True)]
    assert "k2 gave no frames from" in done.warnings()[0]
    assert "to its end" in done.warnings()[1]
    assert sequences(tmp_path / "r.mcap") == {"k1": list(range(12)), "k2": [0, 1, 2, 20, 21, 22]}


def test_frames_that_the_device_lost_are_said(tmp_path: Path) -> None:
    (sensor,) = scripted("k1")
    with running(sensor) as feed:
        give([sensor], [0, 5])
        wait(lambda: feed.health("k1").frames == 2)
        beside = Beside(feed, RecordPlan(tmp_path / "r.mcap"))
        wait(lambda: bool(beside.states))
        give([sensor], [6, 10])
        wait(lambda: beside.taken() == 2)
        beside.stop.set()
        done = beside.end()
    assert done.missed == {"k1": 3}
    assert done.warnings() == ["3 frames of k1 did not come whole from the device: see fruitgui sensors."]


def test_it_ends_before_the_disk_is_full(tmp_path: Path) -> None:
    path, disk, (sensor,) = tmp_path / "r.mcap", Disk(), scripted("k1")
    with running(sensor) as feed:
        beside = Beside(feed, RecordPlan(path, reserve_bytes=2 * GB), disk)
        wait(lambda: bool(beside.states))
        give([sensor], range(20))
        wait(lambda: beside.taken() == 20)
        assert beside.states[-1].room_bytes == 98 * GB
        disk.free = 2 * GB
        done = beside.end()
    assert done.ended is Ending.DISK_FULL
    assert "nearly full" in done.warnings()[0]
    assert sequences(path) == {"k1": list(range(20))}
    assert list(tmp_path.iterdir()) == [path]


def test_a_disk_that_is_full_before_is_said_at_once(tmp_path: Path) -> None:
    with running(*scripted("k1")) as feed, pytest.raises(WorldError, match="less than 2"):
        record_feed(feed, RecordPlan(tmp_path / "r.mcap", reserve_bytes=2 * GB), usage=lambda _: Disk(GB))
    assert list(tmp_path.iterdir()) == []


def test_where_no_frame_ever_comes_there_is_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record_job, "FIRST_FRAME_S", 0.5)
    (sensor,) = scripted("k1")
    sensor.give(gone("k1"))
    with running(sensor) as feed, pytest.raises(WorldError) as caught:
        record_feed(feed, RecordPlan(tmp_path / "r.mcap"))
    assert caught.value.code == "no_frames"
    assert (str(caught.value.what), caught.value.remedy) == (
        "No sensor gave a frame; nothing was recorded. Sensor k1 is gone.", "Plug it in."
    )  # fmt: skip
    assert list(tmp_path.iterdir()) == []


def test_stopped_before_the_first_frame_leaves_nothing(tmp_path: Path) -> None:
    with running(*scripted("k1")) as feed, pytest.raises(CancelledByUserError):
        record_feed(feed, RecordPlan(tmp_path / "r.mcap"), cancelled=lambda: True)
    assert list(tmp_path.iterdir()) == []


def test_sensors_that_end_end_it(tmp_path: Path) -> None:
    (sensor,) = scripted("k1")
    with running(sensor) as feed:
        beside = Beside(feed, RecordPlan(tmp_path / "r.mcap"))
        wait(lambda: bool(beside.states))
        give([sensor], range(5))
        sensor.end()
        done = beside.end()
    assert (done.ended, done.frames) == (Ending.SENSORS_ENDED, {"k1": 5})


def test_a_feed_that_is_stopped_ends_it(tmp_path: Path) -> None:
    (sensor,) = scripted("k1")
    with running(sensor) as feed:
        beside = Beside(feed, RecordPlan(tmp_path / "r.mcap"))
        wait(lambda: bool(beside.states))
        give([sensor], range(5))
        wait(lambda: beside.taken() == 5)
    assert beside.end().frames == {"k1": 5}


def test_what_finds_no_room_is_counted_and_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record_job, "FRAMES_HELD", (3, 3))
    (sensor,) = scripted("k1")
    states: list[RecordState] = []

    def cancelled() -> bool:
        """Hold the recording up, as a disk that stands still does, while eleven frames come."""
        if not states:
            give([sensor], range(11))
            wait(lambda: feed.health("k1").frames == 11)
        return bool(states) and states[-1].frames["k1"] == 3

    with running(sensor) as feed:
        done = record_feed(feed, RecordPlan(tmp_path / "r.mcap"), states.append, cancelled)
    assert states[-1].lost == {"k1": 8}
    assert (done.frames, done.lost) == ({"k1": 3}, {"k1": 8})
    assert done.warnings() == ["8 frames of k1 were lost: this computer, or its disk, was too slow."]
    assert sequences(tmp_path / "r.mcap") == {"k1": [8, 9, 10]}


def test_parts_go_on_where_the_last_ended(tmp_path: Path) -> None:
    path, (sensor,) = tmp_path / "r.mcap", scripted("k1")
    with running(sensor) as feed:
        beside = Beside(feed, RecordPlan(path, split=Split(most_s=0.3)))
        wait(lambda: bool(beside.states))
        for number in range(40):
            give([sensor], [number])
            time.sleep(0.03)
        wait(lambda: beside.taken() == 40)
        beside.stop.set()
        done = beside.end()
    assert len(done.parts) >= 3
    assert parts_after(path) == done.parts[1:]
    assert sequences(*done.parts) == {"k1": list(range(40))}
    assert sorted(tmp_path.iterdir()) == sorted(done.parts)
    assert f"and {len(done.parts) - 1} more parts" in done.line()


def test_devices_have_the_names_that_their_serials_were_given() -> None:
    found = [ScriptedSensor("kinect_1"), ScriptedSensor("kinect_2"), ScriptedSensor("kinect_3")]
    named = named_by_serial(found, {"S-kinect_2": "left", "S-kinect_3": "kinect_1", "S-away": "right"})
    assert [(one.info.sensor, one.info.serial) for one in named] == [
        ("kinect_2", "S-kinect_1"), ("left", "S-kinect_2"), ("kinect_1", "S-kinect_3")
    ]  # fmt: skip
    assert [one.info.sensor for one in only(named, ["left"])] == ["left"]
    with pytest.raises(InputError, match="No sensor 'right' is connected; there are kinect_2, left, kinect_1"):
        only(named, ["right"])


def test_what_the_window_knows_of_the_devices_holds_for_recording_them(tmp_path: Path) -> None:
    assert known_by_workspace(tmp_path / "nowhere") == Known()
    assert not (tmp_path / "nowhere").exists()
    files = open_workspace(tmp_path)
    (tmp_path / "station.json").write_text("{")
    sensor = ConnectedSensor(device="kinect_1", serial="S-1", name="left")
    files.connection.save(Connection(source={"kind": "devices"}, sensors=(sensor,)))
    known = known_by_workspace(tmp_path)
    assert known.names == {"S-1": "left"}
    assert len(known.trouble) == 1
    assert (tmp_path / "station.json").exists(), "it is not for a recording to set it aside"
    assert known.schedule([ScriptedSensor("left")]).slots == ()


def test_two_devices_that_claim_one_serial_are_two() -> None:
    class Same(ScriptedSensor):
        @property
        def info(self) -> SensorInfo:
            return replace(super().info, serial="0000")

    named = named_by_serial([Same("a_1"), Same("a_2")], {"0000": "left"})
    assert [one.info.sensor for one in named] == ["left", "a_2"]
