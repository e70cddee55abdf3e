"""`python -m tests.window.counting FOLDER [go-on]`: the window, which prints each count that it shows.

It starts a lot, or goes on with the one that is open, and runs until it is killed.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Generator

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QApplication, QPushButton

from fruitgui.cli import main
from fruitgui.gui.app import make_qt
from fruitgui.gui.steps.live.lot_dialog import LotDialog
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.window import MainWindow
from fruitgui.station.workflow import Step

LOOK_MS = 5

Script = Generator[Callable[[], bool], None, None]


class Driver(QObject):
    """Goes on with a script whenever what it waits for has come."""

    def __init__(self, script: Script) -> None:
        super().__init__()
        self._script = script
        self._until: Callable[[], bool] = lambda: True
        self._timer = QTimer(self, interval=LOOK_MS)
        self._timer.timeout.connect(self._look)
        self._timer.start()

    def _look(self) -> None:
        if self._until():
            self._until = next(self._script)


def say(words: str) -> None:
    """Tell the test."""
    sys.stdout.write(f"{words}\n")
    sys.stdout.flush()


def counting(go_on: bool) -> Script:
    """Work as a person would, up to where fruit are counted."""
    windows: list[MainWindow] = []

    def shown() -> bool:
        windows[:] = [one for one in QApplication.topLevelWidgets() if isinstance(one, MainWindow) and one.isVisible()]
        return bool(windows)

    yield shown
    window = windows[0]
    page = window.page(Step.LIVE)
    assert isinstance(page, LivePage)
    wanted = page.take_up if go_on else page.start
    yield lambda: window.step is Step.LIVE and page.main_action is wanted and wanted.isEnabled()
    say(f"offered {page.hint}")
    yield lambda: page._session.connected.feed is not None
    wanted.trigger()
    if not go_on:
        yield lambda: page.findChild(LotDialog) is not None
        dialog = page.findChild(LotDialog)
        assert isinstance(dialog, LotDialog)
        dialog.name.setText("1184")
        next(one for one in dialog.findChildren(QPushButton) if one.text() == "Start").click()
    yield lambda: page._running.running
    before = ""
    while True:
        yield lambda before=before: page.body.counts.accessibleDescription() != before  # type: ignore[misc]
        before = page.body.counts.accessibleDescription()
        say(f"shows {sum(int(one.rsplit(': ', 1)[1]) for one in before.split('; '))}")


if __name__ == "__main__":
    make_qt()
    driver = Driver(counting("go-on" in sys.argv))
    sys.exit(main(["--folder", sys.argv[1]]))
