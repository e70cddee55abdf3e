"""Fruit that wait for the disk are all kept at the line's end, however many they are."""

from __future__ import annotations

import queue
import sys
import threading
from collections.abc import Sequence

import numpy as np

from fruitgui.classification.evidence import Evidence
from fruitgui.errors import WorldError
from fruitgui.station.fruit import Fruit
from fruitgui.station.live.counting import LAST_FRUIT, Counting, count_all
from fruitgui.station.live.state import Finished
from fruitgui.station.sink import CountedFruit, Crop
from fruitgui.station.waiting import MOST_AT_ONCE, BufferedSink
from tests.unit.station.fruit_made import made_fruit


class Disk:
    """A sink that is full until its time has come."""

    def __init__(self) -> None:
        self.full = True
        self.kept: list[int] = []

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:  # noqa: ARG002 - as the sink has it
        if self.full:
            raise WorldError("disk_full", "The disk is full.", "Make room.")
        self.kept.append(fruit.fruit)
        return CountedFruit(len(self.kept), lot, len(self.kept), fruit)


def finished(number: int) -> Finished:
    return Finished(made_fruit(number), (), Evidence(np.zeros((1, 1), np.float32), np.zeros(1)), ("left",))


def test_a_fruit_for_which_there_is_no_room_to_wait_is_said() -> None:
    counting = Counting(BufferedSink(Disk(), most=2))
    for number in range(5):
        counting.count(finished(number), 1)
    assert counting.sink_state.waiting == 2
    assert {one.code: one.count for one in counting.warnings}["fruit_not_counted"] == 3
    counting.retry()
    assert {one.code: one.count for one in counting.warnings}["fruit_not_counted"] == 3, "each is said once"


def test_at_the_end_everything_that_waits_is_kept() -> None:
    disk, many = Disk(), 3 * MOST_AT_ONCE + 7
    counting = Counting(BufferedSink(disk))
    out: queue.Queue[Finished | None] = queue.Queue()
    for number in range(many):
        out.put(finished(number))
    out.put(None)

    def take(timeout_s: float) -> Finished | None:
        one = out.get(timeout=timeout_s)
        disk.full = one is not None  # there is room again just before the end
        return one

    count_all(take, lambda one: counting.count(one, 1), counting.retry, lambda *_said: None)
    assert disk.kept == list(range(many))
    assert counting.sink_state.waiting == 0
    assert counting.counted == many


def test_what_a_full_disk_cannot_take_at_the_end_waits_on() -> None:
    disk = Disk()
    counting = Counting(BufferedSink(disk))
    counting.count(finished(1), 1)
    assert not counting.retry()
    assert counting.sink_state.waiting == 1


def test_the_last_fruit_are_read_while_others_are_counted() -> None:
    disk = Disk()
    disk.full = False
    counting, wrong = Counting(BufferedSink(disk)), list[Exception]()
    over = threading.Event()

    def read() -> None:
        try:
            while not over.is_set():
                numbers = [counted.number for counted, _ in counting.last]
                assert numbers == sorted(numbers, reverse=True)
        except Exception as error:  # noqa: BLE001 - told on the test's own thread
            wrong.append(error)

    reader = threading.Thread(target=read)
    before_s = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        reader.start()
        for number in range(1, 2001):
            counting.count(finished(number), 1)
    finally:
        sys.setswitchinterval(before_s)
        over.set()
        reader.join()
    assert wrong == []
    assert [counted.number for counted, _ in counting.last] == list(range(2000, 2000 - LAST_FRUIT, -1))
