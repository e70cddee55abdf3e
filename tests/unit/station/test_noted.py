"""What a sink kept is noted for whoever shows it, each fruit once, and nothing that was not kept."""

from __future__ import annotations

import pytest

from fruitgui.errors import WorldError
from fruitgui.station.noted import NotedSink
from tests.unit.station.fruit_made import made_fruit
from tests.unit.station.memory_sink import MemorySink


def test_each_fruit_that_was_kept_is_noted_once() -> None:
    sink = NotedSink(MemorySink())
    kept = [sink.commit(7, made_fruit(number), ()) for number in (1, 2)]
    assert sink.drain() == kept
    assert sink.drain() == []
    assert [sink.commit(7, made_fruit(3), ())] == sink.drain()


def test_a_fruit_that_could_not_be_kept_is_not_noted_and_nobody_is_called() -> None:
    memory, called = MemorySink(), []
    sink = NotedSink(memory)
    sink.then = lambda: called.append(len(memory.kept))
    sink.commit(7, made_fruit(1), ())
    memory.full.set()
    with pytest.raises(WorldError):
        sink.commit(7, made_fruit(2), ())
    assert [one.number for one in sink.drain()] == [1]
    assert called == [1], "once it is kept"
