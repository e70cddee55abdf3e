"""Measuring the projectors end to end: a simulated rig whose settling and overlaps are known, in the window."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from fruitgui.calibration.projectors.interference import Harm
from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.simulation.show import Showing
from fruitgui.simulation.supply import LineOptions
from fruitgui.station import projector_job
from fruitgui.station.projectors import Projectors
from fruitgui.station.sources import SIMULATED, SimulatedSource, Sources
from fruitgui.station.turn_plan import schedule_of
from fruitgui.station.written import read_written
from tests.gui.opened import in_view, session_on
from tests.unit.simulation.true_light import TrueLight

LONG_MS = 120_000
RIG = LineOptions(rig_seed=1, layout="disconnected", sensors=3, rate_hz=20.0, settling_s=0.3)
"""Two sensors that face each other, a third metres away; each settles in a time of its own."""


@pytest.fixture
def light(monkeypatch: pytest.MonkeyPatch) -> TrueLight:
    return TrueLight(monkeypatch)


@pytest.fixture
def session(qtbot: QtBot, tmp_path: Path) -> Iterator[Session]:
    with session_on(qtbot, tmp_path / "line", Sources((SIMULATED,))) as session:
        session.source.choose(SimulatedSource(RIG))
        qtbot.waitUntil(lambda: session.connected.feed is not None, timeout=LONG_MS)
        yield session


@pytest.fixture
def page(qtbot: QtBot, session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch) -> Iterator[ConnectPage]:
    for name, value in (("TRIALS", 3), ("VIEWS", 20), ("TOGETHER", 10)):
        monkeypatch.setattr(projector_job, name, value)
    with in_view(qtbot, ConnectPage(session, theme)) as page:
        yield page


def test_what_is_true_of_a_simulated_rig_is_found_kept_and_gone_by(
    qtbot: QtBot, session: Session, page: ConnectPage, light: TrueLight, tmp_path: Path
) -> None:
    rig, feed = session.source.rig, session.connected.feed
    assert rig is not None
    assert feed is not None
    qtbot.waitUntil(lambda: all(feed.health(one).frames > 0 for one in feed.sensors), timeout=LONG_MS)
    guessed, said = feed.schedule, page.turns.result.text()
    page.turns.measure.click()
    dialog = page.projectors.dialog
    assert dialog is not None
    qtbot.mouseClick(dialog.begin, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: dialog.working.share > 0.0, timeout=LONG_MS)
    assert rig.showing is Showing.PAUSED, "the belt stands meanwhile"
    qtbot.waitUntil(lambda: "being measured" in page.hint, timeout=LONG_MS)
    assert {(view.condition.word, view.condition.health, view.rate) for view in page.views()} == {
        ("being measured", "", "–")
    }
    assert not page.calibrate_action.isEnabled()
    qtbot.waitUntil(lambda: not dialog.busy, timeout=LONG_MS)
    assert rig.showing is Showing.LINE
    qtbot.waitUntil(lambda: "being measured" not in page.hint, timeout=LONG_MS)
    tried = dialog.tried
    assert tried is not None, dialog._note.text()
    assert set(tried.alone) == set(rig.beams.models)
    for sensor, model in rig.beams.models.items():
        light.check(sensor, model.settle_s, tried.alone[sensor])
    harms = {pair.sensors: {one.harm for one in pair.seen or ()} for pair in tried.pairs}
    assert harms == {
        ("kinect_1", "kinect_2"): {Harm.MUCH},
        ("kinect_1", "kinect_3"): {Harm.NONE},
        ("kinect_2", "kinect_3"): {Harm.NONE},
    }
    qtbot.mouseClick(dialog.keep, Qt.MouseButton.LeftButton)
    path = tmp_path / "line" / "projectors.json"
    qtbot.waitUntil(lambda: path.exists() and read_written(path, Projectors) == session.projectors, timeout=LONG_MS)
    serials = {sensor: info.serial for sensor, info in feed.infos.items()}
    assert set(session.projectors.settlings) == set(serials.values())
    assert all(serial.startswith("SIM") for serial in serials.values())
    for sensor, serial in serials.items():
        measured = session.projectors.settlings[serial].settling()
        assert feed.schedule.settling(sensor) == measured
        assert measured != guessed.settling(sensor)
    assert page.turns.result.text() != said
    # Even where calibration saw none of them overlap, the two that blind each other take turns, and the third does not.
    kept = session.projectors
    plan = schedule_of(feed.infos, [], kept.known(), kept.disturbing(feed.infos.values()))
    assert sorted(plan.slots) == [("kinect_1",), ("kinect_2",)]
    assert not plan.alternates("kinect_3")
