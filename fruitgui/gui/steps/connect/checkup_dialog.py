"""The checkup in the window: what is connected, how well it runs, and what is wrong with it."""

from __future__ import annotations

import json

from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words
from fruitgui.gui.steps.connect.checkup_cards import CheckedSensorCard, ControllerCard, ProblemCard
from fruitgui.gui.steps.connect.checkup_words import doing_words, said, summary_text
from fruitgui.gui.steps.connect.rules_dialog import RulesDialog
from fruitgui.gui.tasks import Job, Task, TaskRunner
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.told import Words
from fruitgui.gui.widgets.cards import EmptyPlace, label, set_role
from fruitgui.gui.widgets.reach import reach
from fruitgui.gui.widgets.working import Working
from fruitgui.progress import Cancelled, Progress
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.udev import RulesInstall, install_rules, rules_install
from fruitgui.station.checkup.records import Checkup, needs_rules

NOTHING = ("nothing_connected", "no_usb")


class CheckupDialog(QDialog):
    """Checks as soon as it is shown, and again when asked; everything that it starts ends with it.

    Args:
        check: does it.
        machine: into which rules go that let everybody use sensors.
        tasks: runs it beside the window.
    """

    def __init__(
        self, check: Job[Checkup], machine: Machine, tasks: TaskRunner, theme: Theme, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._check, self._machine, self._tasks, self._theme = check, machine, tasks, theme
        self._task: Task[Checkup] | None = None
        self._installing: Task[None] | None = None
        self._checkup: Checkup | None = None
        self._note: Words | None = None
        self.rules: RulesDialog | None = None
        self._title, self._summary = label("", "page"), label("", "dim")
        self._working, self._scroll = Working(), QScrollArea()
        self.stop = self._working.stop
        self.again, self.copy = QPushButton(), QPushButton()
        self.let_me, self.leave = QPushButton(), QPushButton()
        self._lay_out()
        self._connect()
        self._say_words()
        self.check()

    @property
    def checkup(self) -> Checkup | None:
        """What was found last; None before that."""
        return self._checkup

    @property
    def busy(self) -> bool:
        """Whether it checks or installs."""
        return self._task is not None or self._installing is not None

    def check(self) -> None:
        """Check, unless it does."""
        if self.busy:
            return
        self._task = self._tasks.run(_checking, self._check, doing_words)
        self._task.progressed.connect(self._show_progress)
        self._task.succeeded.connect(self._found)
        self._task.failed.connect(self._failed)
        self._task.cancelled.connect(self._stopped)
        self._task.ended.connect(self._ended)
        self._note = None
        self._show_busy()

    def done(self, result: int) -> None:
        """Stop what runs, then close."""
        if self._task is not None:
            self._task.cancel()
        super().done(result)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._say_doing()
            self._show()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        self._summary.setWordWrap(True)
        self._scroll.setWidgetResizable(True)
        reach(self._scroll)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        buttons = QHBoxLayout()
        buttons.setSpacing(GRID)
        for button in (self.copy, self.let_me):
            buttons.addWidget(button)
        buttons.addStretch()
        for button in (self.again, self.leave):
            buttons.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        column.setSpacing(2 * GRID)
        for widget in (self._title, self._summary, self._working):
            column.addWidget(widget)
        column.addWidget(self._scroll, 1)
        column.addLayout(buttons)
        self.resize(860, 640)

    def _connect(self) -> None:
        self.again.clicked.connect(self.check)
        self.stop.clicked.connect(self._stop)
        self.copy.clicked.connect(self._copy)
        self.let_me.clicked.connect(self._ask_for_rules)
        self.leave.clicked.connect(self.accept)
        for button in (self.again, self.copy, self.let_me):
            button.setAutoDefault(False)
        self.leave.setDefault(True)

    def _say_words(self) -> None:
        self.setWindowTitle(self.tr("Sensors and USB"))
        self._title.setText(self.tr("Sensors and USB"))
        for button, text, tip, key in (
            (self.again, self.tr("Check again"), self.tr("Look at all sensors anew"), "F5"),
            (self.stop, self.tr("Stop"), self.tr("Stop checking"), ""),
            (self.copy, self.tr("Copy"), self.tr("Copy all of it as text, for whoever helps you"), "Ctrl+C"),
            (self.let_me, self.tr("Let me use them…"), self.tr("Install the rules that let everybody use them"), ""),
            (self.leave, self.tr("Close"), self.tr("Go back to the sensors"), ""),
        ):
            button.setText(text)
            button.setShortcut(key)
            button.setToolTip(f"{tip} ({key})" if key else tip)
            button.setAccessibleName(text)
        self._show()

    # what is shown

    def _show(self) -> None:
        self._show_busy()
        before = self._scroll.takeWidget()
        self._scroll.setWidget(self._contents())
        if before is not None:
            before.deleteLater()

    def _show_busy(self) -> None:
        found = "" if self._checkup is None else summary_text(self._checkup)
        text = found if self._note is None else self._note()
        self._summary.setText(text)
        self._summary.setVisible(bool(text))
        self._working.setVisible(self._task is not None)
        for button in (self.again, self.let_me):
            button.setEnabled(not self.busy)
        self.copy.setEnabled(self._checkup is not None)
        closed = self._checkup is not None and needs_rules(self._checkup.all_problems)
        self.let_me.setVisible(closed)
        set_role(self.let_me, "main" if closed else "plain")
        set_role(self.leave, "plain" if closed else "main")

    def _contents(self) -> QWidget:
        checkup = self._checkup
        if checkup is None:
            text = self.tr("Every sensor appears here, with the USB controller that carries it and what is wrong.")
            return EmptyPlace(self._theme, "connect", self.tr("Checking the sensors"), text)
        nothing = next((one for one in checkup.problems if one.code in NOTHING), None)
        if nothing is not None and len(checkup.problems) == 1:
            return EmptyPlace(self._theme, "connect", *said(nothing))
        cards: list[QWidget] = [ProblemCard(self._theme, checkup.problems)] if checkup.problems else []
        cards += [CheckedSensorCard(self._theme, sensor) for sensor in checkup.sensors]
        cards += [ControllerCard(checkup.controllers)] if checkup.sensors and checkup.controllers else []
        inner = QWidget()
        inner.setProperty("role", "scrolled")
        column = QVBoxLayout(inner)
        column.setContentsMargins(0, 0, GRID, 0)
        column.setSpacing(2 * GRID)
        for card in cards:
            card.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
            column.addWidget(card)
        column.addStretch()
        return inner

    def _show_progress(self, share: float, doing: str) -> None:
        self._working.show_progress(share, doing)
        self._say_doing()

    def _say_doing(self) -> None:
        if self._task is not None:
            self._working.doing.setText(self.tr("Stopping …") if self._task.stopping else self._task.doing)

    # what is done

    def _found(self, checkup: Checkup) -> None:
        self._checkup = checkup

    def _failed(self, error: FruitguiError) -> None:
        def note() -> str:
            told = error_words.told(error)
            return f"{told.what} {told.remedy}"

        self._note = note
        self._show_busy()

    def _stopped(self) -> None:
        self._note = lambda: self.tr("The check was stopped.")

    def _ended(self) -> None:
        self._task = None
        self._working.show_progress(0.0, "")
        self._show()

    def _stop(self) -> None:
        if self._task is not None:
            self._task.cancel()
            self._say_doing()

    def _copy(self) -> None:
        if self._checkup is not None:
            QGuiApplication.clipboard().setText(json.dumps(self._checkup.value(), indent=1, ensure_ascii=False))

    def _ask_for_rules(self) -> None:
        try:
            install = rules_install(self._machine, "pkexec")
        except FruitguiError as error:
            self._failed(error)
            return
        self.rules = RulesDialog(install.target, install.shown(), install.text, self)
        self.rules.accepted.connect(lambda: self._install(install))
        self.rules.finished.connect(self.rules.deleteLater)
        self.rules.open()

    def _install(self, install: RulesInstall) -> None:
        def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001 - the system asks, and takes its time
            install_rules(install)

        self._installing = self._tasks.run(_installing, job)
        self._installing.succeeded.connect(self._installed)
        self._installing.failed.connect(self._failed)
        self._installing.ended.connect(self._install_ended)
        self._show_busy()

    def _installed(self, _: None) -> None:
        self._note = lambda: self.tr(
            "The rules are installed. Unplug the sensors, plug them in again, and check again."
        )

    def _install_ended(self) -> None:
        self._installing = None
        self._show_busy()


def _checking() -> str:
    """Return the job's name, which may outlive the dialog."""
    return QCoreApplication.translate("CheckupDialog", "Checking the sensors")


def _installing() -> str:
    """Return the job's name, which may outlive the dialog."""
    return QCoreApplication.translate("CheckupDialog", "Installing the rules")
