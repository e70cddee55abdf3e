"""Projectors tried in a room of scripted sensors: what is found, kept, and left behind however it ends."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fruitgui.calibration.projectors.interference import Harm
from fruitgui.calibration.projectors.settling import Refusal, Settled
from fruitgui.errors import CancelledByUserError, InputError, WorldError
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.sensor import Projector
from fruitgui.station import projector_job
from fruitgui.station.projector_job import try_projectors
from fruitgui.station.projectors import Projectors
from fruitgui.station.tried import Tried
from fruitgui.station.turn_plan import schedule_of
from fruitgui.station.written import read_written, write_written
from tests.unit.sensors.lit_room import LitRoom, LitSensor

WHEN = datetime(2026, 1, 2, 3, 4, tzinfo=UTC)
LONG_S = 30.0


@contextmanager
def running(*sensors: LitSensor) -> Iterator[Feed]:
    feed = Feed(sensors)
    feed.start()
    try:
        yield feed
    finally:
        assert feed.stop() == ()


def rig(count: int, room: LitRoom, settle_s: float = 0.12) -> list[LitSensor]:
    return [LitSensor(f"kinect_{number + 1}", room, settle_s=settle_s) for number in range(count)]


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(projector_job, "TRIALS", 3)


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("count", [2, 3])
def test_settling_and_interference_of_a_rig_are_found_and_turns_go_on_as_before(count: int, tmp_path: Path) -> None:
    room = LitRoom()
    with running(*rig(count, room)) as feed:
        told: list[tuple[float, str]] = []
        tried = try_projectors(feed, WHEN, lambda share, doing: told.append((share, doing)))
        _takes_turns_again(feed, room)
        assert [share for share, _ in told] == sorted(share for share, _ in told)
        for sensor, found in tried.alone.items():
            assert isinstance(found, Settled), sensor
            assert 0.09 < found.steady_s < 0.30, sensor
            assert found.trials == 3
            assert found.steady.holes == pytest.approx(0.05, abs=0.01)
        assert len(tried.pairs) == count * (count - 1) // 2
        for pair in tried.pairs:
            assert pair.seen is not None
            assert all(one.harm is Harm.MUCH for one in pair.seen)
            assert all(one.holes_together == pytest.approx(0.15, abs=0.01) for one in pair.seen)
        kept = _kept(tried, tmp_path)
        plan = schedule_of(feed.infos, [], kept.known(), kept.disturbing(feed.infos.values()))
        assert len(plan.slots) == count  # no two may shine together, though none was said to overlap
        assert plan.settling("kinect_1").settle_s == kept.settlings["S-kinect_1"].settle_s


@pytest.mark.usefixtures("quick")
def test_a_time_whose_first_pictures_are_missed_is_tried_again() -> None:
    room = LitRoom()
    sensors = rig(2, room)
    with running(*sensors) as feed:
        sensors[0].damaged.set()
        threading.Timer(0.6, sensors[0].damaged.clear).start()
        tried = try_projectors(feed, WHEN)
    found = tried.alone["kinect_1"]
    assert isinstance(found, Settled)
    assert found.trials == 3
    assert found.steady_s < 0.35


def test_a_light_that_is_never_steady_is_said_and_its_pairs_are_not_tried() -> None:
    room = LitRoom()
    slow, quick = LitSensor("slow", room, settle_s=30.0), LitSensor("quick", room)
    with running(slow, quick) as feed, pytest.MonkeyPatch.context() as patch:
        patch.setattr(projector_job, "TRIALS", 3)
        tried = try_projectors(feed, WHEN)
    assert tried.alone["slow"] is Refusal.UNSTEADY
    assert isinstance(tried.alone["quick"], Settled)
    assert tried.pairs == ()
    assert tuple(tried.projectors.settlings) == ("S-quick",)


def test_cancelling_in_the_middle_ends_it_at_once_and_turns_go_on() -> None:
    room = LitRoom()
    with running(*rig(2, room)) as feed:
        stop = threading.Event()
        threading.Timer(0.8, stop.set).start()
        with pytest.raises(CancelledByUserError):
            try_projectors(feed, WHEN, cancelled=stop.is_set)
        _takes_turns_again(feed, room)


@pytest.mark.usefixtures("quick")
def test_a_sensor_that_is_unplugged_meanwhile_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(projector_job, "LONGEST_SILENCE_S", 1.0)
    room = LitRoom()
    sensors = rig(2, room)
    with running(*sensors) as feed:
        threading.Timer(0.5, sensors[1].gone.set).start()
        with pytest.raises(WorldError, match="kinect_2") as caught:
            try_projectors(feed, WHEN)
        assert caught.value.code == "projector_not_seen"


def test_where_nobody_takes_turns_there_is_nothing_to_measure() -> None:
    room = LitRoom()
    alone = LitSensor("alone", room)
    harmless = LitSensor("harmless", room, projector=Projector.HARMLESS)
    with running(alone, harmless) as feed, pytest.raises(InputError, match="take turns"):
        try_projectors(feed, WHEN)


def test_what_is_measured_anew_takes_the_place_of_what_was(tmp_path: Path) -> None:
    room = LitRoom()
    with running(*rig(2, room)) as feed, pytest.MonkeyPatch.context() as patch:
        patch.setattr(projector_job, "TRIALS", 3)
        tried = try_projectors(feed, WHEN)
    kept = _kept(tried, tmp_path)
    (pair,) = kept.interferences
    turned = pair.model_copy(update={"serials": pair.serials[::-1], "harm": (Harm.NONE, Harm.NONE)})
    again = kept.renewed(Projectors(interferences=(turned,)))
    assert again.interferences == (turned,)
    assert again.settlings == kept.settlings
    assert not again.disturbing(feed.infos.values())


def _kept(tried: Tried, folder: Path) -> Projectors:
    path = folder / "projectors.json"
    write_written(path, Projectors().renewed(tried.projectors))
    return read_written(path, Projectors)


def _takes_turns_again(feed: Feed, room: LitRoom) -> None:
    """Wait until frames come as usual, and see that no two shine."""
    queue = feed.subscribe(100)
    until_s = time.monotonic() + LONG_S
    seen: set[str] = set()
    while seen != set(feed.sensors):
        assert time.monotonic() < until_s
        arrival = queue.take(0.1)
        if arrival is not None:
            assert not arrival.lit.others
            assert not arrival.lit.rehearsed
            assert len(room.lit()) <= 1
            seen.add(arrival.frame.sensor)
    queue.close()
