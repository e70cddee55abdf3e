"""Times in which sensors were away: written down as they begin and end, whatever happens in between."""

from __future__ import annotations

import multiprocessing
import os
import signal
from multiprocessing.connection import Connection
from pathlib import Path

from fruitgui.records.lot import LotPlan
from fruitgui.records.store import Store, open_store
from fruitgui.station.live.blind import Blind
from tests.unit.records.conftest import Clock
from tests.unit.station.fruit_made import made_fruit

LEFT = Blind(("kinect_2",), ((0.41, 0.65),), 0.65, 0.3)
BOTH = Blind(("kinect_1", "kinect_2"), ((0.0, 0.65),), 0.65, 1.0)
UNKNOWN = Blind(("kinect_2",), None, None, 0.25)
LESS = Blind(("kinect_2",), (), 0.65, 0.0)


def test_a_spell_lasts_from_when_a_sensor_is_missed_until_it_is_back(store: Store, clock: Clock) -> None:
    lot = store.lots.start(LotPlan("1")).key
    began_s = clock.now_s
    store.spells.note(lot, LEFT)
    clock.now_s += 20.0
    store.spells.note(lot, LEFT)  # said again: nothing new
    (going_on,) = store.lots.get(lot).spells
    assert (going_on.from_s, going_on.to_s, going_on.blind) == (began_s, None, LEFT)
    assert going_on.lasted_s(clock.now_s) == 20.0
    store.spells.note(lot, BOTH)
    clock.now_s += 10.0
    store.spells.note(lot, None)
    clock.now_s += 5.0
    store.spells.note(lot, UNKNOWN)
    clock.now_s += 1.0
    ended = store.lots.end(lot)
    times = [(one.from_s - began_s, (one.to_s or 0.0) - began_s, one.blind) for one in ended.spells]
    assert times == [(0.0, 20.0, LEFT), (20.0, 30.0, BOTH), (35.0, 36.0, UNKNOWN)]
    store.spells.note(lot, LESS)
    assert len(store.lots.get(lot).spells) == 3, "an ended lot is told nothing"
    store.spells.note(77, LESS)


def test_a_moved_rig_and_clocks_that_leapt_are_kept_apart_from_absences(store: Store, clock: Clock) -> None:
    lot = store.lots.start(LotPlan("1")).key
    began_s = clock.now_s
    store.spells.note(lot, LEFT)
    clock.now_s += 10.0
    store.spells.note_moved(lot, ("kinect_1",))
    clock.now_s += 10.0
    store.spells.note_moment(lot, "clock_jumped", ("kinect_2",))
    store.spells.note_moved(lot, ("kinect_1",))  # said again: nothing new
    store.spells.note(lot, None)
    clock.now_s += 10.0
    store.spells.note_moved(lot, ("kinect_1", "kinect_2"))
    clock.now_s += 10.0
    ended = store.lots.end(lot)
    assert [(one.blind, one.to_s) for one in ended.spells] == [(LEFT, began_s + 20.0)]
    assert [(one.sort, one.from_s - began_s, (one.to_s or 0.0) - began_s, one.sensors) for one in ended.troubles] == [
        ("moved", 10.0, 30.0, ("kinect_1",)),
        ("clock_jumped", 20.0, 20.0, ("kinect_2",)),
        ("moved", 30.0, 40.0, ("kinect_1", "kinect_2")),
    ]
    store.spells.note_moved(lot, ())
    store.spells.note_moment(lot, "clock_jumped", ("kinect_2",))
    assert len(store.lots.get(lot).troubles) == 3, "an ended lot is told nothing"


def test_of_a_lot_that_was_left_open_a_moved_rig_does_not_go_on(store: Store, clock: Clock) -> None:
    lot = store.lots.start(LotPlan("1")).key
    store.spells.note_moved(lot, ("kinect_1",))
    clock.now_s += 3600.0
    left_open = store.lots.left_open()
    assert left_open is not None
    assert [one.to_s for one in left_open.troubles] == [left_open.started_s]


def test_a_clock_that_was_set_back_ends_no_spell_before_it_began(store: Store, clock: Clock) -> None:
    lot = store.lots.start(LotPlan("1")).key
    store.spells.note(lot, LEFT)
    clock.now_s -= 3600.0
    store.spells.note(lot, None)
    (spell,) = store.lots.get(lot).spells
    assert spell.lasted_s(clock.now_s) == 0.0


def test_what_a_crash_left_going_on_ends_with_the_last_sign_of_the_lot(tmp_path: Path) -> None:
    ours, theirs = multiprocessing.get_context("spawn").Pipe()
    process = multiprocessing.get_context("spawn").Process(target=_run_and_wait, args=(tmp_path, theirs))
    process.start()
    theirs.close()
    assert ours.poll(60.0)
    lot = ours.recv()
    assert process.pid is not None
    os.kill(process.pid, signal.SIGKILL)
    process.join()
    with open_store(tmp_path, lambda: 9000.0) as store:
        open_lot = store.lots.open_lot()
        assert open_lot is not None
        assert [one.to_s for one in open_lot.spells] == [None]
        left_open = store.lots.left_open()
        assert left_open is not None
        assert [one.to_s for one in left_open.spells] == [1000.0], "it does not grow until taken up"
        taken_up = store.lots.take_up(lot)
        (spell,) = taken_up.spells
        assert (spell.from_s, spell.to_s, spell.blind) == (1000.0, 1000.0, LEFT)
        assert taken_up.pauses[0].from_s == 1000.0


def _run_and_wait(folder: Path, pipe: Connection) -> None:
    with open_store(folder, lambda: 1000.0) as store:
        lot = store.lots.start(LotPlan("1")).key
        store.counting.commit(lot, made_fruit(1), ())
        store.spells.note(lot, LEFT)
        pipe.send(lot)
        pipe.recv()


def test_what_was_seen_too_seldom_is_kept_apart_from_what_was_not_seen(store: Store, clock: Clock) -> None:
    lot = store.lots.start(LotPlan("1")).key
    began_s = clock.now_s
    store.spells.note(lot, LEFT)
    clock.now_s += 10.0
    store.spells.note(lot, LESS, "sparse")
    clock.now_s += 10.0
    store.spells.note(lot, None)
    clock.now_s += 10.0
    store.spells.note(lot, LESS, "sparse")  # said again: nothing new
    store.spells.note(lot, None, "sparse")
    ended = store.lots.end(lot)
    assert [(one.sort, one.from_s - began_s, (one.to_s or 0.0) - began_s, one.blind) for one in ended.spells] == [
        ("away", 0.0, 20.0, LEFT),
        ("sparse", 10.0, 30.0, LESS),
    ]
    assert ended.troubles == ()
