"""Measuring the projectors, as the connect screen has it: when it can be done, and the dialog for it."""

from __future__ import annotations

import math
from contextlib import nullcontext
from datetime import UTC, datetime

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.presenter import plan_of
from fruitgui.gui.steps.connect.projectors.dialog import ProjectorsDialog
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.told import Told
from fruitgui.progress import Cancelled, Progress
from fruitgui.station.projector_job import lasts_s, try_projectors
from fruitgui.station.projectors import Projectors
from fruitgui.station.tried import Tried
from fruitgui.station.turn_plan import TurnPlan


class ProjectorDesk(QObject):
    """Lets a person measure the projectors of the sensors that run.

    Args:
        session: whose sensors are measured, and who keeps what was found.
        theme: of the dialog.
        page: over which it is opened.

    Attributes:
        dialog: while it is open, and the last one afterwards; None before the first.
    """

    def __init__(self, session: Session, theme: Theme, page: QWidget) -> None:
        super().__init__(page)
        self._session, self._theme, self._page = session, theme, page
        self.dialog: ProjectorsDialog | None = None

    @property
    def trying(self) -> bool:
        """Whether projectors are switched on and off now, to be measured."""
        return self.dialog is not None and self.dialog.busy

    def plan(self, measured: Projectors | None = None) -> TurnPlan | None:
        """Return how projectors take turns, or would with what was measured, too; None where no sensor runs."""
        known = self._session.projectors
        known = known if measured is None else known.renewed(measured)
        return plan_of(self._session.connected.feed, self._session.station, known)

    def ask(self) -> None:
        """Open the dialog, where sensors run."""
        feed = self._session.connected.feed
        if feed is None:
            return

        rig = self._session.source.rig

        def measure(progress: Progress, cancelled: Cancelled) -> Tried:
            with nullcontext() if rig is None else rig.standing():
                return try_projectors(feed, datetime.now(UTC), progress, cancelled)

        minutes = max(math.ceil(lasts_s(feed) / 60.0), 1)
        self.dialog = ProjectorsDialog(measure, minutes, self.plan, self._session.tasks, self._theme, self._page)
        self.dialog.kept.connect(self._keep)
        self.dialog.finished.connect(self.dialog.deleteLater)
        self.dialog.open()

    def _keep(self, measured: Projectors) -> None:
        self._session.save_projectors(self._session.projectors.renewed(measured))
        self._session.messages.info(lambda: Told(self.tr("The projectors take turns by what was measured.")))
