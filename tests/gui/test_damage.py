"""What is damaged at the start is named, kept aside unharmed, and the last good one offered."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from fruitgui.gui.app import Application
from fruitgui.gui.messages import Level
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.workspace import open_workspace


def _station() -> Station:
    rig = still_scene(1, "single", fruit=1).rig()
    return Station(
        rig.reference, {name: StationSensor("A1", one.pose, one.surface) for name, one in rig.mounts.items()}
    )


def test_a_damaged_station_is_set_aside_and_the_last_good_one_is_a_press_away(
    qtbot: QtBot, qapp: QApplication, tmp_path: Path
) -> None:
    workspace = open_workspace(tmp_path / "line")
    workspace.station.save(_station())
    workspace.station.save(_station())
    workspace.station.path.write_text("{half a stat", encoding="utf-8")
    application = Application(qapp, workspace.folder)
    application.start()
    try:
        (message,) = application.session.messages.history
        assert (message.level, message.stays) == (Level.BAD, True)
        assert "station.json" in message.what
        assert (workspace.folder / "station.damaged-1.json").read_text(encoding="utf-8") == "{half a stat"
        assert application.session.station is None
        button = next(
            one for one in application.window.action_bar.findChildren(QPushButton) if one.text() == message.action
        )
        button.click()
        qtbot.waitUntil(lambda: application.session.station is not None)
        assert workspace.station.load().value is not None
    finally:
        application.window.close()
        application.window.deleteLater()
        QCoreApplication.sendPostedEvents(application.window, QEvent.Type.DeferredDelete)
        application.deleteLater()
