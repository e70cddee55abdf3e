"""The screen on which the belt is set."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QHBoxLayout, QStackedWidget, QVBoxLayout, QWidget

from fruitgui.frame import F64
from fruitgui.gui.session import Session
from fruitgui.gui.step_words import reason_text
from fruitgui.gui.steps.belt.advice import advice
from fruitgui.gui.steps.belt.backdrop import Backdrop
from fruitgui.gui.steps.belt.draft import Draft, added, draft_of, moved, removed, undone, with_measured
from fruitgui.gui.steps.belt.measuring import plan_motion
from fruitgui.gui.steps.belt.motion_desk import MotionDesk
from fruitgui.gui.steps.belt.projection import Projection, Through, above, motion_arrow
from fruitgui.gui.steps.belt.region_canvas import RegionCanvas
from fruitgui.gui.steps.belt.saving import save_belt
from fruitgui.gui.steps.belt.side_panel import SidePanel
from fruitgui.gui.steps.belt.tool_row import ABOVE, ToolRow
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.ways import at_root, ways_on
from fruitgui.gui.widgets.cards import EmptyPlace
from fruitgui.gui.widgets.scrolled import Scrolled
from fruitgui.sensors.feed import Feed
from fruitgui.station.belt_setting import area_m2
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.station import Station
from fruitgui.station.workflow import State, Step
from fruitgui.tracking.belt import BeltMotion

DRAW_MS = 125
SIDE_WIDTH = 344
ABOVE_SIZE = (1000, 640)


class BeltPage(StepPage):
    """Region in every picture and from above; motion and heights beside."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._draft: Draft | None = None
        self._station: Station | None = None
        self._spread_m_s: float | None = None
        self._shown = ABOVE
        self._changed = False
        self.nothing, self.canvas = EmptyPlace(theme, "belt"), RegionCanvas(theme)
        self.side, self.tools = SidePanel(session, theme), ToolRow(theme)
        self._stack, self._backdrop = QStackedWidget(), Backdrop(self)
        self.motion = MotionDesk(session, self)
        self._draw = QTimer(self, interval=DRAW_MS)
        self.save_action, self.undo_action = QAction(self), QAction(self)
        self._lay_out()
        self._connect()
        self._say_words()
        self._take_station()

    @property
    def draft(self) -> Draft | None:
        """The belt as it stands on the screen."""
        return self._draft

    def entered(self) -> None:
        """Draw."""
        self.side.switch.follow()
        self._feed_changed()
        self._draw.start()

    def left(self) -> None:
        """Rest; what was set and can be is saved."""
        self._draw.stop()
        self._backdrop.queries.rest()
        if self._changed and self._draft is not None and not self._draft.problem:
            self._save()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._show_actions()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        scroll = Scrolled(self.side)
        scroll.setFixedWidth(SIDE_WIDTH)
        left = QVBoxLayout()
        left.setSpacing(GRID)
        left.addWidget(self.tools)
        left.addWidget(self.canvas, 1)
        setting = QWidget()
        row = QHBoxLayout(setting)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * GRID)
        row.addLayout(left, 1)
        row.addWidget(scroll)
        self._stack.addWidget(self.nothing)
        self._stack.addWidget(setting)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        whole.addWidget(self._stack)

    def _connect(self) -> None:
        session, canvas, side = self._session, self.canvas, self.side
        session.station_changed.connect(self._station_changed)
        session.connected.changed.connect(self._feed_changed)
        session.states_changed.connect(self._show_actions)
        self._draw.timeout.connect(self._draw_picture)
        self._backdrop.made.connect(canvas.show_image)
        self._backdrop.queries.failed.connect(session.messages.error)
        self.tools.chosen.connect(self._choose_view)
        self.tools.add.connect(self._add_chosen)
        self.tools.remove.connect(self._remove_chosen)
        self.tools.reset.connect(self._take_station)
        canvas.dragged.connect(self._drag)
        canvas.added.connect(self._add)
        canvas.removed.connect(self._remove)
        side.changed.connect(self._set)
        side.measure.connect(self._measure)
        self.motion.found.connect(self._take_motion)
        self.motion.changed.connect(self._show_draft)
        self.save_action.triggered.connect(self._save)
        self.undo_action.triggered.connect(self._undo)

    def _say_words(self) -> None:
        for action, text, tip, icon, key in (
            (self.save_action, self.tr("Save belt"), self.tr("Save region, motion and heights"), "save", "Ctrl+Return"),
            (self.undo_action, self.tr("Undo"), self.tr("Take back the last change to the region"), "undo", "Ctrl+Z"),
        ):
            action.setText(text)
            action.setToolTip(tip)
            action.setProperty("drawing", icon)
            action.setShortcut(key)
        self.nothing.show_words(
            self.tr("No belt is known yet"),
            self.tr("Calibrate first; then the belt that the sensors found is drawn here, and its region can be set."),
        )
        self.canvas.setAccessibleName(self.tr("Region of the belt"))
        self.canvas.setToolTip(
            self.tr(
                "Drag a corner; or: Space next corner, arrows move it (Shift: far), Insert adds one, Del removes it"
            )
        )

    # what is shown

    def _take_station(self) -> None:
        """Begin with what is saved."""
        station = self._session.station
        self._station, self._spread_m_s, self._changed = station, None, False
        self._draft = None if station is None else draft_of(station)
        self._stack.setCurrentIndex(0 if station is None else 1)
        if station is not None:
            self._shown = self._shown if self._shown in station.sensors else ABOVE
            self.tools.show_sensors(tuple(station.sensors), self._shown)
        self._feed_changed()

    def _station_changed(self) -> None:
        """Begin anew with another station; one that was saved here is on the screen already."""
        if self._session.station is not self._station:
            self._take_station()

    def _feed_changed(self) -> None:
        self._show_view()
        self._show_draft()

    def _feed(self) -> Feed | None:
        return self._session.connected.feed

    def _show_view(self) -> None:
        """Show the belt from above, or through the chosen sensor where its lens is known."""
        station, draft, feed = self._station, self._draft, self._feed()
        if station is None or draft is None:
            return
        camera = None if feed is None or self._shown not in feed.infos else feed.infos[self._shown].intrinsics
        view: Projection = above(draft.corners_m, draft.axis_rad, *ABOVE_SIZE)
        if self._shown != ABOVE and camera is not None:
            view = Through(station, self._shown, camera)
        self.canvas.show_view(view)
        self._backdrop.show_view(station, view)

    def _draw_picture(self) -> None:
        feed = self._feed()
        if feed is not None:
            self._backdrop.draw(feed)

    def _show_draft(self) -> None:
        draft = self._draft
        if draft is not None:
            self.canvas.show_region(
                draft.corners_m, draft.axis_rad, motion_arrow(draft.motion, draft.corners_m, self.canvas.view)
            )
            self.tools.show_region(len(draft.corners_m), area_m2(draft.corners_m))
            self.side.show_draft(draft, self._spread_m_s)
        self.side.busy(self.motion.busy, ready=self._feed() is not None)
        self._show_actions()

    def _show_actions(self) -> None:
        draft, states = self._draft, self._session.states()
        if draft is None:
            missing = at_root(Step.BELT, states)
            self.offer(self.way_to(next(iter(ways_on(missing)), Step.CALIBRATE)))
            self.say(reason_text(missing))
            return
        calibrating = states[Step.CALIBRATE]
        done = not self._changed and self._session.marks.belt_calibration == self._fingerprint()
        self.undo_action.setEnabled(draft.before is not None)
        self.save_action.setEnabled(not draft.problem and not self.motion.busy)
        if calibrating.state is State.REDO and not self._changed:
            self.offer(self.way_to(Step.CALIBRATE), self.undo_action)
            self.say(reason_text(calibrating))
            return
        to_sensors = () if self._feed() is not None else (self.way_to(Step.CONNECT),)
        self.offer(self.way_to(Step.TEACH) if done else self.save_action, *to_sensors, self.undo_action)
        self.say(advice(draft, states[Step.BELT], done=done, measuring=self.motion.busy, connected=not to_sensors))

    def _fingerprint(self) -> str:
        return "" if self._station is None else calibration_fingerprint(self._station)

    # what is done

    def _choose_view(self, shown: str) -> None:
        self._shown = shown
        self._show_view()
        self._show_draft()
        self._draw_picture()

    def _edit(self, draft: Draft) -> None:
        if draft is not self._draft:
            self._draft, self._changed = draft, True
            self._show_draft()

    def _drag(self, corner: int, to_m: F64, let_go: bool) -> None:
        draft = self._draft
        if draft is None:
            return
        base = draft if draft.dragging is None else draft.dragging
        after = moved(base, corner, to_m)
        if after is base:
            return
        self._edit(after if let_go else after.held(base))

    def _add(self, corner: int) -> None:
        if self._draft is not None:
            self._edit(added(self._draft, corner))

    def _remove(self, corner: int) -> None:
        if self._draft is not None:
            self._edit(removed(self._draft, corner))

    def _add_chosen(self) -> None:
        self._add(self.canvas.corner)

    def _remove_chosen(self) -> None:
        self._remove(self.canvas.corner)

    def _set(self, draft: Draft) -> None:
        if self._spread_m_s is not None and draft.motion != (None if self._draft is None else self._draft.motion):
            self._spread_m_s = None  # what is typed was not measured
        self._edit(draft)

    def _undo(self) -> None:
        if self._draft is not None:
            self._edit(undone(self._draft))

    def _measure(self) -> None:
        feed, station = self._feed(), self._station
        if feed is not None and station is not None:
            self.motion.measure(feed, station)

    def _take_motion(self, found: BeltMotion) -> None:
        station, draft = self._station, self._draft
        if station is not None and draft is not None:
            self._spread_m_s = float(np.sqrt(max(np.trace(found.covariance), 0.0) / 3.0))
            self._edit(with_measured(draft, plan_motion(station, found)))

    def _save(self) -> None:
        draft, station = self._draft, self._station
        if draft is None or station is None or draft.problem:
            return
        spread = self._spread_m_s
        save_belt(self._session, draft, station)
        self._take_station()
        self._spread_m_s = spread
        self._show_draft()
