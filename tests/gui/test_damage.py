"""What is damaged at the start is named, kept aside unharmed, and the last good one offered."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from fruitgui.classification.evidence import Evidence, LabelledFruit
from fruitgui.classification.training import train
from fruitgui.errors import InputError
from fruitgui.gui.app import Application
from fruitgui.gui.line_plans import model_reader
from fruitgui.gui.logs import CRASH, LOG
from fruitgui.gui.messages import Level
from fruitgui.measurement.correction import VolumeCorrection
from fruitgui.records.store import open_store
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.judging import FEATURES
from fruitgui.station.model import Model
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.workspace import Workspace, open_workspace


def _station() -> Station:
    rig = still_scene(1, "single", fruit=1).rig()
    return Station(
        rig.reference, {name: StationSensor("A1", one.pose, one.surface) for name, one in rig.mounts.items()}
    )


@cache
def tiny_model() -> Model:
    """Return a model of two kinds that differ in everything."""
    random = np.random.default_rng(1)

    def fruit(kind: int, number: int) -> LabelledFruit:
        views = random.normal(4.0 * kind, 1.0, (5, len(FEATURES.view))).astype(np.float32)
        sizes = random.uniform(1.0, 1.1, len(FEATURES.fruit)) * (1.0 + kind)
        return LabelledFruit(f"{kind}-{number}", f"kind {kind}", Evidence(views, sizes))

    taught = [fruit(kind, number) for kind in (0, 1) for number in range(4)]
    return Model(train(taught, FEATURES, seed=1).model, VolumeCorrection())


@contextmanager
def opened(qapp: QApplication, workspace: Workspace) -> Iterator[Application]:
    """Give the window on a workspace; it is closed and gone afterwards."""
    application = Application(qapp, workspace.folder)
    application.start()
    try:
        yield application
    finally:
        application.window.close()
        application.window.deleteLater()
        QCoreApplication.sendPostedEvents(application.window, QEvent.Type.DeferredDelete)
        application.deleteLater()


def press(application: Application, words: str) -> None:
    """Press a button below."""
    buttons = application.window.action_bar.findChildren(QPushButton)
    next(one for one in buttons if one.text() == words).click()


def with_models(folder: Path, *good: bool) -> Workspace:
    """Return a line with models of which the last is in use; bad ones are no models at all."""
    workspace = open_workspace(folder)
    for one in good:
        file = workspace.add_model(tiny_model())
        if not one:
            file.path.write_text("no model", encoding="utf-8")
    with open_store(workspace.folder) as store:
        for file in workspace.models():
            store.models.use(store.models.add(file.name, {}, {}))
    workspace.station.save(replace(_station(), model=workspace.models()[-1].name))
    return workspace


def test_a_damaged_station_is_set_aside_and_the_last_good_one_is_a_press_away(
    qtbot: QtBot, qapp: QApplication, tmp_path: Path
) -> None:
    workspace = open_workspace(tmp_path / "line")
    workspace.station.save(_station())
    workspace.station.save(_station())
    workspace.station.path.write_text("{half a stat", encoding="utf-8")
    with opened(qapp, workspace) as application:
        (message,) = application.session.messages.history
        assert (message.level, message.stays) == (Level.BAD, True)
        assert "station.json" in message.what
        assert (workspace.folder / "station.damaged-1.json").read_text(encoding="utf-8") == "{half a stat"
        assert application.session.station is None
        press(application, message.action)
        qtbot.waitUntil(lambda: application.session.station is not None)
        assert workspace.station.load().value is not None


def test_logs_that_cannot_be_written_keep_no_window_from_opening(qapp: QApplication, tmp_path: Path) -> None:
    workspace = open_workspace(tmp_path / "line")
    for name in (LOG, CRASH):
        (workspace.folder / name).mkdir()
    with opened(qapp, workspace) as application:
        assert application.window.isVisible()


def test_what_could_not_be_set_aside_is_not_said_to_be(qapp: QApplication, tmp_path: Path) -> None:
    workspace = open_workspace(tmp_path / "line")
    workspace.station.path.mkdir()
    with opened(qapp, workspace) as application:
        (message,) = application.session.messages.history
        assert "station.json cannot be used; it lies where it was" in message.what
    assert workspace.station.path.is_dir()


def test_a_damaged_model_is_said_before_a_lot_needs_it_and_the_last_good_one_is_a_press_away(
    qtbot: QtBot, qapp: QApplication, tmp_path: Path
) -> None:
    workspace = with_models(tmp_path / "line", True, True, False)
    with opened(qapp, workspace) as application:
        session = application.session
        qtbot.waitUntil(lambda: bool(session.messages.history), timeout=30_000)
        (message,) = session.messages.history
        assert (message.level, message.stays) == (Level.BAD, True)
        assert "model-0003.fruit is damaged" in message.what
        assert (workspace.folder / "models" / "model-0003.damaged-1.fruit").read_text(encoding="utf-8") == "no model"
        press(application, "Take the last good one")
        qtbot.waitUntil(lambda: "in use" in session.messages.history[-1].what)
        assert session.station is not None
        assert session.station.model == "models/model-0002.fruit"
        in_use = session.store.models.in_use()
        assert in_use is not None
        assert in_use.file == "models/model-0002.fruit"


def test_where_no_model_is_left_one_may_count_without(qtbot: QtBot, qapp: QApplication, tmp_path: Path) -> None:
    workspace = with_models(tmp_path / "line", False)
    with opened(qapp, workspace) as application:
        session = application.session
        qtbot.waitUntil(lambda: bool(session.messages.history), timeout=30_000)
        assert session.station is not None
        read = model_reader(session.workspace, session._saving, session.station)
        with pytest.raises(InputError) as raised:
            read()
        assert raised.value.code == "no_such_model"
        press(application, "Count without a model")
        qtbot.waitUntil(lambda: "unknown" in session.messages.history[-1].what)
        assert session.station.model is None


def test_a_good_model_is_no_matter(qtbot: QtBot, qapp: QApplication, tmp_path: Path) -> None:
    workspace = with_models(tmp_path / "line", True)
    with opened(qapp, workspace) as application:
        check = application._model_check
        qtbot.waitUntil(lambda: application.page_making.finished and not check._queries.busy, timeout=30_000)
        assert not application.session.messages.history
