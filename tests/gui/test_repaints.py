"""Painting again and again: no reference to `None` is lost on the way, of which the process would die in the end."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QPaintEvent
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.drawn import BeltMap, DrawnFruit, DrawnPicture, KindLine, LastFruit, MappedFruit
from fruitgui.gui.pages import Pages
from fruitgui.gui.session import Session
from fruitgui.gui.steps.live.layout import LiveLayout
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.kinds import kind_marks
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.widgets.histogram import Bars
from fruitgui.station.live.state import Spread
from fruitgui.station.workflow import Step
from tests.gui.xvfb import run_on_screen

REPAINTS = 150
WARM = 10
LOST = REPAINTS // 3
"""Less than one in three paintings, whatever else comes and goes in the process."""

pytestmark = pytest.mark.skipif(sys.version_info >= (3, 12), reason="None is not counted any more")

SCRIPT = f"""
import sys
import numpy as np
from PySide6.QtWidgets import QApplication
from fruitgui.gui.steps.calibrate.cloud_view import CloudView
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.fused_cloud import SensorCloud

app = QApplication([])
view = CloudView(Theme())
if view.solid is None:
    sys.exit(77)
view.resize(320, 240)
view.show()
points = np.random.default_rng(1).uniform(-0.4, 0.4, (500, 3)).astype(np.float32)
view.show_clouds([SensorCloud("a", points, points, np.zeros((500, 3), np.uint8))], compared=True)

def paint(times):
    for _ in range(times):
        view.solid.view.grabFramebuffer()
        view.repaint()
        app.processEvents()

paint({WARM})
before = sys.getrefcount(None)
paint({REPAINTS})
lost = before - sys.getrefcount(None)
assert lost < {LOST}, lost
view.close()
"""


class Paintings(QObject):
    """Counts how often a widget is painted."""

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self.count = 0
        widget.installEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        self.count += event.type() == QEvent.Type.Paint
        return False


def lost_by(qtbot: QtBot, widget: QWidget) -> int:
    """Show a widget and paint it often; return how many references to `None` are gone."""
    with qtbot.waitExposed(widget):
        widget.show()
    for _ in range(WARM):
        widget.repaint()
    paintings, before = Paintings(widget), sys.getrefcount(None)
    for _ in range(REPAINTS):
        widget.repaint()
    lost = before - sys.getrefcount(None)
    assert paintings.count == REPAINTS
    widget.hide()
    return lost


@pytest.fixture
def pages(qtbot: QtBot, session: Session, theme: Theme) -> dict[Step, StepPage]:
    made = dict(Pages(session, theme))
    for page in made.values():
        page.complete()
        qtbot.addWidget(page)
    qtbot.waitUntil(lambda: not session.tasks.running)
    return made


@pytest.mark.parametrize("step", list(Step))
def test_no_screen_loses_anything_by_being_painted(qtbot: QtBot, pages: dict[Step, StepPage], step: Step) -> None:
    page = pages[step]
    page.resize(1072, 586)
    assert lost_by(qtbot, page) < LOST


def test_the_live_screen_loses_nothing_with_fruit_on_it(qtbot: QtBot, theme: Theme) -> None:
    marks = kind_marks(["lemon", "red apple"])
    layout = LiveLayout(theme)
    qtbot.addWidget(layout)
    layout.resize(1072, 586)
    layout.pictures.show_sensors(["kinect_1", "kinect_2"])
    outline = np.array([[280, 200], [360, 200], [360, 280], [280, 280]], dtype=np.float32)
    trail, ellipse = np.array([[0.0, 240.0], [320.0, 240.0]]), Spread(320.0, 240.0, 12.0, 6.0, 0.0)
    fruit = DrawnFruit(7, marks["lemon"], outline, ("lemon 98 %", "112 ml"), ellipse, trail)
    grey = np.full((480, 640, 3), 90, np.uint8)
    for sensor, picture in layout.pictures.pictures.items():
        picture.show_picture(DrawnPicture(sensor, grey, (fruit,), "good", "10/s"))
    stale = DrawnPicture("kinect_2", grey, (fruit,), "bad", "silent", "no picture for 12 s")
    layout.pictures.pictures["kinect_2"].show_picture(stale)
    way = np.array([[0.0, 0.2], [0.3, 0.2]])
    on_belt = MappedFruit(7, marks["lemon"], 0.04, Spread(0.3, 0.2, 1e-3, 1e-3, 0.0), way)
    footprint = np.array([[0.0, 0.0], [1.2, 0.0], [1.2, 0.4], [0.0, 0.4]])
    layout.belt.show_map(BeltMap({"kinect_1": footprint}, frozenset(), (on_belt,), 0.1))
    layout.counts.show_lines([KindLine(marks["lemon"], "Lemon", 3, 110.0, 2.0, 8.0, 0.3, None, 12)])
    layout.standing.show_words("Nothing is counted", "Lot 1184 is paused.")
    layout.last.show_fruit([LastFruit(1, 1, marks["lemon"], "Lemon", 0.98, 112.0, 2.0, None)])
    layout.histogram.show_bars([Bars(marks["lemon"], np.array([1, 3, 2]))], 80.0, 140.0)
    assert lost_by(qtbot, layout) < LOST


class _Leaky(QWidget):
    """Loses a reference at every painting, as one release of the binding did."""

    painted = 0

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        self.painted += 1
        ctypes.pythonapi.Py_DecRef(ctypes.py_object(None))


def test_a_loss_would_be_seen(qtbot: QtBot) -> None:
    leaky = _Leaky()
    qtbot.addWidget(leaky)
    lost = lost_by(qtbot, leaky)
    for _ in range(leaky.painted):
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(None))
    assert lost > LOST


def test_the_cloud_in_three_dimensions_loses_nothing(tmp_path: Path) -> None:
    run_on_screen(SCRIPT, tmp_path)
