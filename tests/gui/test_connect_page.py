"""The connect screen on a rig that shows the same pictures over and over."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QApplication
from pytestqt.qtbot import QtBot

from fruitgui.errors import InputError
from fruitgui.gui.session import Session
from fruitgui.gui.shots.frozen import FrozenSource, frozen_source, frozen_sources, with_projectors
from fruitgui.gui.steps.connect.chooser import SourceChooser
from fruitgui.gui.steps.connect.offers import SIMULATED
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.records.lot import LotPlan
from fruitgui.records.spells import Spell
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.live import LineApart
from fruitgui.station.live.blind import Blind
from fruitgui.station.projectors import MeasuredSettling, Projectors
from fruitgui.station.sources import Connected, DeviceId, DevicesSource, Make, RecordedSource, Sources
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.workflow import State, Step
from fruitgui.station.workspace import open_workspace


@pytest.fixture(scope="module")
def rendered() -> FrozenSource:
    return frozen_source(still_scene(3, "opposed", 4, captures=2), shown_as=SIMULATED)


@pytest.fixture
def rig(rendered: FrozenSource) -> FrozenSource:
    for sensor in rendered.sensors:
        sensor.silent.clear()
        sensor.broken.clear()
    return rendered


@pytest.fixture
def rigged(qtbot: QtBot, tmp_path: Path, rig: FrozenSource) -> Iterator[Session]:
    made = Session(open_workspace(tmp_path / "line"), sources=frozen_sources(rig))
    yield made
    assert made.close()
    qtbot.waitUntil(lambda: not made.tasks.running)
    made.deleteLater()


@pytest.fixture
def page(qtbot: QtBot, rigged: Session, theme: Theme) -> ConnectPage:
    made = ConnectPage(rigged, theme)
    qtbot.addWidget(made)
    made.resize(1072, 580)
    made.show()
    made.entered()
    return made


def _connect(qtbot: QtBot, session: Session, page: ConnectPage) -> None:
    row = next(row for row in page.chooser.rows if row.offer.key == SIMULATED)
    qtbot.mouseClick(row, Qt.MouseButton.LeftButton)
    page.connect_action.trigger()
    _running(qtbot, session, page)


def _running(qtbot: QtBot, session: Session, page: ConnectPage) -> None:
    qtbot.waitUntil(lambda: not session.source.opening, timeout=20_000)
    qtbot.waitUntil(lambda: all(view.condition.health == "good" for view in page.views()), timeout=20_000)


def _names(page: ConnectPage) -> list[str]:
    return [tile.text() for tile in page.tiles.tiles]


def test_without_a_connection_everything_that_can_be_connected_is_listed(page: ConnectPage) -> None:
    assert [row.offer.key for row in page.chooser.rows] == ["recording", SIMULATED]
    assert page.main_action is page.connect_action
    assert not page.connect_action.isEnabled(), "no file is chosen yet"
    page.chooser.take_file(Path("a.mcap"))
    assert page.chooser.source == RecordedSource(Path("a.mcap"), looped=True)
    assert page.connect_action.isEnabled()


def test_a_device_that_is_plugged_in_appears_by_itself(
    qtbot: QtBot, tmp_path: Path, theme: Theme, rig: FrozenSource
) -> None:
    plugged: list[FrozenSource] = []
    make = Make("device", lambda: list(plugged), lambda _value: rig)
    session = Session(open_workspace(tmp_path / "line"), sources=Sources((*Sources().makes, make)))
    page = ConnectPage(session, theme)
    qtbot.addWidget(page)
    page.entered()
    assert len(page.chooser.rows) == 2
    plugged.append(FrozenSource("Kinect A1", rig.sensors, "device"))
    qtbot.waitUntil(lambda: [row.text() for row in page.chooser.rows][:1] == ["Kinect A1"])
    page.left()
    assert session.close()
    session.deleteLater()


def test_sensors_that_are_plugged_in_are_chosen_until_a_person_chooses(qtbot: QtBot, theme: Theme) -> None:
    chooser = SourceChooser(theme)
    qtbot.addWidget(chooser)
    kinects = DevicesSource((DeviceId("kinect", "A1"), DeviceId("kinect", "B2")))
    chooser.show_found([])
    assert chooser.source is None
    chooser.update_found([kinects])
    assert chooser.source == kinects
    assert chooser.rows[0].text() == "2 × Kinect"
    qtbot.mouseClick(chooser.rows[1], Qt.MouseButton.LeftButton)
    chooser.update_found([])
    chooser.update_found([kinects])
    assert chooser.source is None, "a recording was chosen, and no file yet"


def test_the_keyboard_comes_to_the_list_and_then_to_what_is_chosen(
    qtbot: QtBot, page: ConnectPage, rig: FrozenSource, qapp: QApplication
) -> None:
    chooser = page.chooser
    page.activateWindow()
    qtbot.waitUntil(page.isActiveWindow)
    chooser.rows[0].setFocus()
    qtbot.keyClick(chooser.rows[0], Qt.Key.Key_Tab)
    first = qapp.focusWidget()
    assert first is not None
    assert chooser.form.isAncestorOf(first)
    qtbot.keyClick(first, Qt.Key.Key_Backtab, Qt.KeyboardModifier.ShiftModifier)
    assert qapp.focusWidget() in chooser.rows
    chooser.show_found([rig, replace(rig, name="another")])
    assert qapp.focusWidget() in chooser.rows, "what is plugged in takes nobody's place"


def test_connecting_shows_each_sensor_live_and_is_kept(
    qtbot: QtBot, rigged: Session, page: ConnectPage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, page)
    assert _names(page) == ["kinect_1", "kinect_2"]
    assert rigged.states()[Step.CONNECT].state is State.DONE
    qtbot.waitUntil(lambda: not rigged.saving)
    kept = rigged.workspace.connection.load().value
    assert kept is not None
    assert [one.serial for one in kept.sensors] == [one.info.serial for one in rig.sensors]
    first = page.tiles.tiles[0]
    qtbot.waitUntil(lambda: first.thumbnails is not None)
    assert page.main_action is page.calibrate_action
    assert not page.turns.picture.isVisible()
    assert "10.0 pictures" in page.turns.result.text()


def test_sensors_that_blind_each_other_are_seen_to_take_turns(
    qtbot: QtBot, tmp_path: Path, theme: Theme, rig: FrozenSource
) -> None:
    session = Session(open_workspace(tmp_path / "line"), sources=frozen_sources(with_projectors(rig)))
    page = ConnectPage(session, theme)
    qtbot.addWidget(page)
    page.resize(1072, 580)
    page.show()
    page.entered()
    _connect(qtbot, session, page)
    assert page.turns.picture.accessibleName() == "kinect_1 → kinect_2"
    assert page.turns.picture.isVisible()
    assert "2.4 of 10.0" in page.turns.result.text()  # 0.02 s to switch, three frames to settle, three to keep
    session.save_projectors(Projectors(settlings={rig.sensors[0].info.serial: MeasuredSettling(
        settle_s=1.0, discard_frames=10, steady_s=0.9, holes=0.1, trials=3, when=datetime.now(UTC)
    )}))  # fmt: skip
    feed = session.connected.feed
    assert feed is not None
    assert feed.schedule.cycle_s == pytest.approx(0.62 + 1.32)
    qtbot.waitUntil(lambda: "1.5 of 10.0" in page.turns.result.text(), timeout=20_000)
    assert session.close()
    session.deleteLater()


def test_pictures_are_drawn_only_while_they_are_looked_at(qtbot: QtBot, rigged: Session, page: ConnectPage) -> None:
    _connect(qtbot, rigged, page)
    assert page.tiles._draw.isActive()
    page.left()
    assert not page.tiles._draw.isActive()
    page.entered()
    assert page.tiles._draw.isActive()


def test_sensors_start_again_by_themselves_at_the_next_start(
    qtbot: QtBot, rigged: Session, page: ConnectPage, theme: Theme, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, page)
    page.changes.rename("left")
    _running(qtbot, rigged, page)
    assert rigged.close()
    again = Session(open_workspace(rigged.workspace.folder), sources=frozen_sources(rig))
    other = ConnectPage(again, theme)
    qtbot.addWidget(other)
    again.start_sensors()
    _running(qtbot, again, other)
    assert _names(other) == ["left", "kinect_2"]
    feed = again.connected.feed
    assert feed is not None
    qtbot.waitUntil(lambda: (frame := feed.newest("left")) is not None and frame.sensor == "left")
    assert again.close()
    again.deleteLater()


def test_a_name_is_typed_checked_and_kept(qtbot: QtBot, rigged: Session, page: ConnectPage) -> None:
    _connect(qtbot, rigged, page)
    field = page.details.name
    field.selectAll()
    qtbot.keyClicks(field, "left side")
    assert page.details._problem.text().startswith("A name has letters")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert field.text() == "kinect_1"
    field.selectAll()
    qtbot.keyClicks(field, "left")
    assert page.details._problem.text() == ""
    qtbot.keyClick(field, Qt.Key.Key_Return)
    _running(qtbot, rigged, page)
    assert _names(page) == ["left", "kinect_2"]
    assert rigged.connection is not None
    assert rigged.connection.reference_name == "left"


def test_order_and_reference_are_kept(qtbot: QtBot, rigged: Session, page: ConnectPage) -> None:
    _connect(qtbot, rigged, page)
    qtbot.mouseClick(page.tiles.tiles[1], Qt.MouseButton.LeftButton)
    qtbot.mouseClick(page.details.buttons["reference"], Qt.MouseButton.LeftButton)
    qtbot.mouseClick(page.details.buttons["left"], Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: not rigged.saving)
    assert _names(page) == ["kinect_2", "kinect_1"]
    kept = rigged.workspace.connection.load().value
    assert kept is not None
    assert kept.reference == "kinect_2"
    assert [one.name for one in kept.sensors] == ["kinect_2", "kinect_1"]
    assert not page.details.buttons["left"].isEnabled(), "it is the first already"


def test_identify_flashes_the_chosen_tile(qtbot: QtBot, rigged: Session, page: ConnectPage) -> None:
    _connect(qtbot, rigged, page)
    qtbot.mouseClick(page.tiles.tiles[1], Qt.MouseButton.LeftButton)
    qtbot.mouseClick(page.details.buttons["identify"], Qt.MouseButton.LeftButton)
    assert [tile.flashing for tile in page.tiles.tiles] == [False, True]
    qtbot.waitUntil(lambda: not page.tiles.tiles[1].flashing)


def test_leaving_out_can_be_undone(qtbot: QtBot, rigged: Session, page: ConnectPage) -> None:
    _connect(qtbot, rigged, page)
    page.details.leave.emit()
    _running(qtbot, rigged, page)
    assert _names(page) == ["kinect_2"]
    assert not page.details.buttons["leave"].isEnabled(), "the last one stays"
    undo = rigged.messages.history[-1].act
    assert undo is not None
    undo()
    _running(qtbot, rigged, page)
    assert _names(page) == ["kinect_1", "kinect_2"]


def test_a_silent_sensor_is_said_with_its_remedy(
    qtbot: QtBot, rigged: Session, page: ConnectPage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, page)
    rig.sensors[1].silent.set()
    qtbot.waitUntil(lambda: page.views()[1].condition.word == "no pictures", timeout=10_000)
    assert not page.calibrate_action.isEnabled()
    assert "1 of 2" in page.hint
    rig.sensors[1].silent.clear()
    qtbot.waitUntil(lambda: page.views()[1].condition.health == "good", timeout=10_000)
    assert page.calibrate_action.isEnabled()


def test_a_lot_remembers_when_pictures_were_too_few_and_nothing_of_a_pause(
    qtbot: QtBot, rigged: Session, page: ConnectPage, rendered: FrozenSource, monkeypatch: pytest.MonkeyPatch
) -> None:
    _start_lot(qtbot, rigged, page, rendered)
    lot, sparse = rigged.running.lot, Blind(("kinect_1",), (), 0.65, 0.0)
    assert lot is not None

    def spells() -> list[tuple[Blind, bool]]:
        found = rigged.store.lots.get(lot.key).spells
        return [(one.blind, one.to_s is not None) for one in found if one.sort == "sparse"]

    real = LineApart.state.fget  # type: ignore[attr-defined]
    monkeypatch.setattr(LineApart, "state", property(lambda line: replace(real(line), sparse=sparse)))
    qtbot.waitUntil(lambda: spells() == [(sparse, False)], timeout=20_000)
    rigged.running.pause()
    qtbot.waitUntil(lambda: spells() == [(sparse, True)], timeout=20_000)
    rigged.running.resume()
    qtbot.waitUntil(lambda: spells() == [(sparse, True), (sparse, False)], timeout=20_000)
    monkeypatch.setattr(LineApart, "state", property(real))
    qtbot.waitUntil(lambda: spells() == [(sparse, True), (sparse, True)], timeout=20_000)


def test_while_a_lot_runs_no_sensor_is_changed(
    qtbot: QtBot, rigged: Session, page: ConnectPage, rendered: FrozenSource
) -> None:
    _start_lot(qtbot, rigged, page, rendered)
    assert not page.change_action.isEnabled()
    assert not page.details.name.isEnabled()
    assert {name for name, button in page.details.buttons.items() if button.isEnabled()} == {"identify"}
    assert "lot has ended" in page.hint
    rigged.running.end_lot()
    qtbot.waitUntil(lambda: not rigged.running.running, timeout=20_000)
    assert page.change_action.isEnabled()


def test_a_lot_remembers_when_a_sensor_was_away_and_what_was_not_seen(
    qtbot: QtBot, rigged: Session, page: ConnectPage, rendered: FrozenSource, rig: FrozenSource
) -> None:
    _start_lot(qtbot, rigged, page, rendered)
    lot = rigged.running.lot
    assert lot is not None
    began_s = time.time()

    def absences() -> list[Spell]:
        return [one for one in rigged.store.lots.get(lot.key).spells if one.sort == "away"]

    rig.sensors[1].broken.set()
    qtbot.waitUntil(lambda: len(absences()) == 1, timeout=20_000)
    rig.sensors[1].broken.clear()
    qtbot.waitUntil(lambda: absences()[0].to_s is not None, timeout=20_000)
    rigged.running.pause()
    qtbot.waitUntil(lambda: rigged.running.paused, timeout=20_000)
    rig.sensors[1].broken.set()
    qtbot.waitUntil(lambda: rigged.running.state is not None and rigged.running.state.blind is not None, timeout=20_000)
    assert len(absences()) == 1, "what passes uncounted is not missed"
    rigged.running.resume()
    qtbot.waitUntil(lambda: len(absences()) == 2, timeout=20_000)
    assert rigged.running.close()
    spell, left = absences()
    assert left.to_s is not None, "of a lot that is left open nothing goes on"
    assert began_s - 1.0 <= spell.from_s <= (spell.to_s or 0.0) <= time.time()
    assert spell.blind.sensors == ("kinect_2",)


def _start_lot(qtbot: QtBot, rigged: Session, page: ConnectPage, rendered: FrozenSource) -> None:
    _connect(qtbot, rigged, page)
    mounts = still_scene(3, "opposed", 4, captures=2).rig().mounts
    serials = {sensor.info.sensor: sensor.info.serial for sensor in rendered.sensors}
    sensors = {name: StationSensor(serials[name], one.pose, one.surface) for name, one in mounts.items()}
    rigged.save_station(Station("kinect_1", sensors))
    rigged.start_lot(LotPlan("Lot 1"))
    qtbot.waitUntil(lambda: rigged.running.running, timeout=20_000)


class _Locked:
    kind, name = SIMULATED, "locked"

    def value(self) -> dict[str, object]:
        return {"kind": self.kind, "name": self.name}

    def connect(self) -> Connected:
        raise InputError("in_use", "The device is in use by another program.", "Close the other program.")


def test_a_source_that_cannot_be_opened_is_said_and_another_can_be_chosen(
    qtbot: QtBot, rigged: Session, page: ConnectPage
) -> None:
    rigged.source.choose(_Locked())
    qtbot.waitUntil(lambda: rigged.source.failure is not None and not rigged.source.opening)
    assert rigged.messages.history[-1].what == "The device is in use by another program."
    assert rigged.connection is None
    _connect(qtbot, rigged, page)
    assert rigged.source.failure is None


def test_the_keyboard_alone_does_everything(qtbot: QtBot, rigged: Session, page: ConnectPage) -> None:
    page.activateWindow()
    qtbot.waitUntil(page.isActiveWindow)
    rows = page.chooser.rows
    rows[0].setFocus()
    qtbot.keyClick(rows[0], Qt.Key.Key_Down)
    assert rows[1].isChecked()
    qtbot.keyClick(page, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    _running(qtbot, rigged, page)
    first = page.tiles.tiles[0]
    first.setFocus()
    qtbot.keyClick(first, Qt.Key.Key_Right)
    assert page.details.name.text() == "kinect_2"
    qtbot.keyClick(page, Qt.Key.Key_Left, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: _names(page) == ["kinect_2", "kinect_1"])
    wanted: list[object] = []
    page.step_wanted.connect(wanted.append)
    qtbot.keyClick(page, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert wanted == [Step.CALIBRATE]


def test_everything_that_is_pressed_is_large_enough_for_a_glove(
    qtbot: QtBot, rigged: Session, page: ConnectPage
) -> None:
    shown = [*page.findChildren(QAbstractButton)]
    _connect(qtbot, rigged, page)
    shown += page.findChildren(QAbstractButton)
    small = [one.accessibleName() for one in shown if one.isVisible() and min(one.height(), one.width()) < 40]
    assert small == []


def test_cards_are_no_higher_than_their_words_on_a_large_screen(
    qtbot: QtBot, rigged: Session, page: ConnectPage
) -> None:
    _connect(qtbot, rigged, page)
    page.resize(3632, 2020)
    qtbot.waitUntil(lambda: page.turns.isVisible() and page.tiles.height() > 1500)
    for card in (page.details, page.turns):
        assert card.height() <= max(card.heightForWidth(card.width()), card.sizeHint().height()) + 8
