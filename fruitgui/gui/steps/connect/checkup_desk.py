"""Lets a person have the sensors checked."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.checkup_dialog import CheckupDialog
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.checkup.job import CheckupPlan, check_up
from fruitgui.station.checkup.measuring import MeasuringBeside, measure

CHECK_S = 4.0
"""How long sensors are watched while they are checked."""


class CheckupDesk(QObject):
    """Opens the dialog, beside whatever runs.

    Args:
        session: whose sensors are known by name; those that run are watched as they run.
        theme: of the dialog.
        page: over which it is opened.

    Attributes:
        dialog: while it is open, and the last one afterwards; None before the first.
    """

    def __init__(self, session: Session, theme: Theme, page: QWidget) -> None:
        super().__init__(page)
        self._session, self._theme, self._page = session, theme, page
        self.dialog: CheckupDialog | None = None

    def ask(self) -> None:
        """Open the dialog."""
        feed, others = self._session.connected.feed, None if self._session.running.running else measure
        watching = measure if feed is None else MeasuringBeside(feed, others)
        connection = self._session.connection
        named = () if connection is None else tuple(one for one in connection.sensors if one.serial)
        plan = CheckupPlan(CHECK_S, watching=watching, known_as={one.serial: one.name for one in named})
        self.dialog = CheckupDialog(partial(check_up, plan), plan.machine, self._session.tasks, self._theme, self._page)
        self.dialog.finished.connect(self.dialog.deleteLater)
        self.dialog.open()
