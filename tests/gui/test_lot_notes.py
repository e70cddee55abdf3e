"""What a lot remembers of the line's warnings: each once, and nothing of a pause."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from fruitgui.gui.lot_notes import LotNotes
from fruitgui.gui.queries import Queries
from fruitgui.records.lot import LotPlan, Pause
from fruitgui.records.store import Store, open_store
from fruitgui.station.live import LiveState, LiveWarning, Phase


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with open_store(tmp_path) as opened:
        yield opened


def _leapt(count: int) -> LiveWarning:
    return LiveWarning("clock_jumped", "", ("kinect_1",), count)


def _state(warnings: list[LiveWarning]) -> LiveState:
    return LiveState(Phase.RUNNING, warnings=tuple(warnings))


MOVED = LiveWarning("calibration_stale", "", ("kinect_2",))


def test_each_is_noted_once_and_nothing_of_a_pause(qtbot: QtBot, store: Store) -> None:  # noqa: ARG001 - Qt runs
    lot = store.lots.start(LotPlan("1"))
    paused = replace(lot, pauses=(Pause(lot.started_s, None, "asked"),))
    queries = Queries()
    notes = LotNotes(queries, store.spells)
    for warnings in ([], [_leapt(1)], [_leapt(1)], [_leapt(2), MOVED], [_leapt(2), MOVED]):
        notes.note(lot, _state(warnings))
    for warnings in ([_leapt(2), MOVED], [_leapt(5), MOVED]):
        notes.note(paused, _state(warnings))
    notes.note(lot, _state([_leapt(5), MOVED]))
    assert queries.finish()
    found = store.lots.get(lot.key).troubles
    assert sorted((one.sort, one.sensors) for one in found) == [
        ("clock_jumped", ("kinect_1",)),
        ("clock_jumped", ("kinect_1",)),
        ("moved", ("kinect_2",)),
        ("moved", ("kinect_2",)),
    ]
    assert [one.to_s is None for one in found if one.sort == "moved"] == [False, True], "the pause is no part of it"


@pytest.mark.parametrize("code", ["mostly_unknown", "line_begun_again"])
def test_a_lot_remembers_each_time_of_what_is_about_no_sensor(qtbot: QtBot, store: Store, code: str) -> None:  # noqa: ARG001 - Qt runs
    lot = store.lots.start(LotPlan("1"))
    queries = Queries()
    notes = LotNotes(queries, store.spells)

    def said(count: int) -> list[LiveWarning]:
        return [LiveWarning(code, "", (), count)]

    for warnings in ([], said(1), said(1), said(2), said(2)):
        notes.note(lot, _state(warnings))
    assert queries.finish()
    store.lots.end(lot.key)
    found = store.lots.get(lot.key).troubles
    assert [(one.sort, one.sensors) for one in found] == 2 * [(code, ())]
    assert all(one.to_s == one.from_s for one in found), "when it came is known, when it went is not"
