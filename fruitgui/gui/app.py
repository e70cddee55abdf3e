"""Starts the window: the only place that knows all of its parts."""

from __future__ import annotations

import signal
import sys
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtGui import QIcon, QKeySequence, QShortcut
from PySide6.QtWidgets import QApplication, QDialog

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words
from fruitgui.gui.closing import ClosingQuestion
from fruitgui.gui.enlarged import enlarged
from fruitgui.gui.gc_confinement import ConfinedCollector
from fruitgui.gui.health import HealthWatch
from fruitgui.gui.help_window import HelpWindow
from fruitgui.gui.housekeeping import Housekeeping
from fruitgui.gui.logs import Logs
from fruitgui.gui.memory import GivingBack
from fruitgui.gui.messages import Level, Message
from fruitgui.gui.model_check import ModelCheck
from fruitgui.gui.pages import PageMaking, Pages
from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.settings_dialog import SettingsDialog
from fruitgui.gui.speed_watch import SpeedWatch
from fruitgui.gui.store_trouble import StoreTrouble, opened
from fruitgui.gui.tasks import unexpected_error
from fruitgui.gui.theme.theme import Theme, load_fonts
from fruitgui.gui.told import Told
from fruitgui.gui.translate import Language
from fruitgui.gui.window import MainWindow
from fruitgui.resources import folder
from fruitgui.station.kept_file import Damage
from fruitgui.station.settings import Settings
from fruitgui.station.workflow import opening_step
from fruitgui.station.workspace import Workspace, open_workspace

HAND_OVER_S = 1e-3
"""After so long a thread of Python's lets another go on if it waits. With Python's own five milliseconds the window,
which waits for each of the line's threads in turn, would stand still for a tenth of a second."""

WAKE_MS = 200
"""How often Python gets a look in while Qt waits, so that an interrupt from the keyboard is heard."""


class Application(QObject):
    """One window on one workspace, with everything that lives as long as it does."""

    def __init__(self, qt: QApplication, workspace_folder: Path | None) -> None:
        super().__init__()
        self._qt = qt
        self.theme = Theme(parent=self)
        self.language = Language(self)
        load_fonts()
        workspace = open_workspace(workspace_folder)
        self.session = opened(lambda: Session(workspace, self), lambda error: self._trouble(workspace, error))
        self._logs = Logs(self.session.workspace.folder)
        self._collector = ConfinedCollector(self)
        self._hand_over_s = sys.getswitchinterval()
        self._help: HelpWindow | None = None
        self._settings: SettingsDialog | None = None
        self._dress(self.session.settings)
        pages = Pages(self.session, self.theme)
        self.window = MainWindow(self.theme, self.session.messages, self.session.tasks, pages, self._close)
        self.closing = ClosingQuestion(self.window, lambda: self.session.running.unkept)
        self.page_making = PageMaking(
            self.window, pages.__getitem__, self.window.page, lambda step: pages[step].complete(), self
        )
        self.page_making.done.connect(self._collector.leave_out)
        self._health = HealthWatch(self.session, self.window.top_bar, self)
        self._speed_watch = SpeedWatch(self.session, self)
        self._housekeeping = Housekeeping(self.session, self)
        self._giving_back = GivingBack(self)
        self._model_check = ModelCheck(self.session, self)
        self.page_making.done.connect(self._model_check.look)
        self._connect()

    def start(self) -> None:
        """Show the window and begin to look after things."""
        sys.setswitchinterval(HAND_OVER_S)
        self._logs.open(
            lambda error: self.session.messages.error(unexpected_error(lambda: self.tr("the window"), error))
        )
        self._collector.start()
        self._health.start()
        self._housekeeping.start()
        self._giving_back.start()
        self.session.running.find_open_lot()
        self._show_states()
        self.window.go_to(opening_step(self.session.states()))
        self.window.show()
        self.session.start_sensors()
        for damage in self.session.damages:
            self.session.messages.say(self._damaged(damage))

    def _damaged(self, damage: Damage) -> Message:
        """Return what is said of a file that could not be read; the last good one is offered where there is one."""

        def told() -> Told:
            if damage.set_aside is None:
                what, why = (
                    self.tr("{file} cannot be used; it lies where it was."),
                    error_words.told(damage.error).remedy,
                )
            else:
                what, why = (
                    self.tr("{file} is damaged; it was set aside, unharmed."),
                    error_words.told(damage.error).what,
                )
            action = "" if damage.last_good is None else self.tr("Take the last good one")
            return Told(what.format(file=damage.file.name), why, action)

        take = None if damage.last_good is None else partial(self.session.take_last_good, damage)
        return Message(Level.BAD, told, take, stays=True)

    def _close(self) -> bool:
        """End all that runs; it was saved as it came, or is now. False where it cannot be, and a person is asked."""
        if self.closing.keeps_open():
            return False
        self.page_making.stop()
        self._housekeeping.stop()
        self._health.stop()
        self._giving_back.stop()
        self._model_check.stop()
        for one in self.window.findChildren(Queries):
            one.finish()
        self.session.close()
        self._collector.stop()
        sys.setswitchinterval(self._hand_over_s)
        self._logs.close()
        return True

    def _connect(self) -> None:
        self.session.settings_changed.connect(self._dress_anew)
        self.session.states_changed.connect(self._show_states)
        bar = self.window.top_bar
        bar.theme_wanted.connect(self._other_theme)
        bar.settings_wanted.connect(self._show_settings)
        bar.help_wanted.connect(self._show_help)
        QShortcut(QKeySequence("Ctrl+,"), self.window, self._show_settings)
        QShortcut(QKeySequence("F1"), self.window, self._show_help)
        QShortcut(QKeySequence("Ctrl+T"), self.window, self._other_theme)
        QShortcut(QKeySequence("F11"), self.window, self._full_screen)

    def _trouble(self, workspace: Workspace, error: FruitguiError) -> StoreTrouble:
        self._dress(workspace.settings.load().value or Settings())
        return StoreTrouble(workspace.folder, error)

    def _dress_anew(self) -> None:
        self._dress(self.session.settings)

    def _dress(self, settings: Settings) -> None:
        theme = settings.theme
        if theme == "system":
            light = self._qt.styleHints().colorScheme() == Qt.ColorScheme.Light
            theme = "light" if light else "dark"
        self.language.put_on(self._qt, settings.language)
        self.theme.put_on(self._qt, theme)

    def _other_theme(self) -> None:
        other = "light" if self.theme.name == "dark" else "dark"
        self.session.save_settings(self.session.settings.model_copy(update={"theme": other}))

    def _show_settings(self) -> None:
        self._settings = SettingsDialog(self.session.settings, self.window)
        self._settings.finished.connect(self._settings_done)
        self._settings.open()

    def _settings_done(self, result: int) -> None:
        if self._settings is not None:
            if result == QDialog.DialogCode.Accepted:
                self.session.save_settings(self._settings.chosen)
            self._settings.deleteLater()
            self._settings = None

    def _show_help(self) -> None:
        if self._help is None:
            self._help = HelpWindow(self.theme, self.language, self._logs.path, self.window)
            self._help.finished.connect(self._forget_help)
        self._help.show()
        self._help.raise_()
        if self.window.step is not None:
            self._help.show_step(self.window.step)

    def _forget_help(self) -> None:
        if self._help is not None:
            self._help.deleteLater()
            self._help = None

    def _full_screen(self) -> None:
        if self.window.isFullScreen():
            self.window.showNormal()
        else:
            self.window.showFullScreen()

    def _show_states(self) -> None:
        self.window.show_states(self.session.states())


def run(workspace_folder: Path | None = None) -> int:
    """Open the window and return the exit code when it is closed.

    Raises:
        WorldError: the workspace's folder cannot be made; or its records cannot be opened, and the person gave up.
    """
    qt = enlarged(make_qt, (open_workspace(workspace_folder).settings.glance() or Settings()).words_percent)
    application = Application(qt, workspace_folder)
    application.start()
    waker = QTimer(interval=WAKE_MS)
    waker.timeout.connect(lambda: None)
    waker.start()
    # Python hears a signal wherever it is, in the middle of a painting too: the window closes after that.
    close = partial(QTimer.singleShot, 0, application.window, application.closing.close_unasked)
    before = {number: signal.signal(number, lambda *_: close()) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        return qt.exec()
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def make_qt() -> QApplication:
    """Return the process's Qt application, named for the desktop."""
    existing = QApplication.instance()
    if isinstance(existing, QApplication):
        return existing
    qt = QApplication(sys.argv[:1])
    qt.setApplicationName("fruitgui")
    qt.setApplicationDisplayName("fruitgui")
    qt.setDesktopFileName("fruitgui")
    qt.setWindowIcon(QIcon(str(folder("icons") / "fruitgui.svg")))
    return qt
