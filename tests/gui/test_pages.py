"""Screens are made when they are wanted, and all of them soon after the first painting."""

from __future__ import annotations

import subprocess
import sys

from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.pages import PageMaking, Pages
from fruitgui.gui.session import Session
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.window import MainWindow
from fruitgui.station.workflow import Step


def test_a_screen_is_made_once_when_it_is_first_wanted(qtbot: QtBot, session: Session, theme: Theme) -> None:
    pages = Pages(session, theme)
    window = MainWindow(theme, session.messages, session.tasks, pages)
    qtbot.addWidget(window)
    assert not pages._made
    window.go_to(Step.TRAIN)
    assert list(pages._made) == [Step.TRAIN]
    assert window.page(Step.TRAIN) is pages[Step.TRAIN]
    seen = []
    for at, wanted in ((Step.TRAIN, Step.LIVE), (Step.LIVE, Step.TRAIN)):
        window.page(at).step_wanted.emit(wanted)
        seen.append(window.step)
    assert seen == [Step.LIVE, Step.TRAIN]
    assert list(pages._made) == [Step.TRAIN, Step.LIVE]


def test_all_screens_are_made_after_the_first_painting(qtbot: QtBot) -> None:
    window, done = QWidget(), list[tuple[str, Step]]()
    qtbot.addWidget(window)
    done_to = [lambda step, what=what: done.append((what, step)) for what in ("made", "placed", "completed")]
    making = PageMaking(window, *done_to)
    QCoreApplication.processEvents()
    assert not done
    with qtbot.waitSignal(making.done, timeout=60_000):
        window.show()
    assert done == [(what, step) for step in Step for what in ("made", "placed", "completed")]
    making.stop()


def test_no_more_are_made_once_it_is_stopped(qtbot: QtBot) -> None:
    window, made, placed, completed = QWidget(), list[Step](), list[Step](), list[Step]()
    qtbot.addWidget(window)
    making = PageMaking(window, made.append, placed.append, completed.append)
    with qtbot.waitExposed(window):
        window.show()
    qtbot.waitUntil(lambda: len(made) > 0, timeout=60_000)
    making.stop()
    assert not making.running
    assert not making.finished
    assert made == placed == completed, "none is left without a place, or unfinished"


def test_the_window_loads_no_screen_before_one_is_wanted() -> None:
    told = (
        "import sys, fruitgui.gui.app\n"
        "print([one for one in sys.modules if one.startswith('fruitgui.gui.steps') and one.endswith('.page')])"
    )
    said = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "['fruitgui.gui.steps.page']"


def test_all_of_qts_classes_are_there_before_the_loader_may_run() -> None:
    program = """
from PySide6 import QtCore, QtGui, QtWidgets
from fruitgui.gui.app import make_qt
from fruitgui.gui.pages import PageMaking
qt = make_qt()
lazy = {module: set(dir(module)) - set(vars(module)) for module in (QtCore, QtGui, QtWidgets)}
making = PageMaking(QtWidgets.QWidget(), print, print, print)
for module, names in lazy.items():
    print(len(names), len(names - set(vars(module))))
print(making.running)
"""
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60)
    *counts, running = told.stdout.split()
    lazy, left = counts[::2], counts[1::2]
    assert sum(map(int, lazy)) > 300
    assert left == ["0", "0", "0"]
    assert running == "False"
