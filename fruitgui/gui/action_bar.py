"""The bar at the bottom: one line on what to do or what happened, and the actions of the screen."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QProgressBar, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from fruitgui.gui.messages import Level, Message
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.tasks import Task
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.worded import Worded

SHOWN_MS = 8000
ICON_PX = 24
STEPS = 1000
_COLOURS = {Level.INFO: "text_dim", Level.GOOD: "good", Level.WARN: "warn", Level.BAD: "bad"}


class ActionButton(QPushButton):
    """A button that is an action: its words, its state, its key.

    Attributes:
        main: whether it is the one that the operator most likely wants.
    """

    def __init__(self, action: QAction, theme: Theme, *, main: bool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._action = action
        self._theme = theme
        self.main = main
        self._offered = False  # one that is seen before it has its place is laid out and dressed twice
        self._drawn: tuple[str, str, str] | None = None
        self.setProperty("role", "main" if main else "plain")
        self.clicked.connect(action.trigger)
        action.changed.connect(self._follow)
        theme.changed.connect(self._follow)
        self._follow()

    def offer(self, offered: bool) -> None:
        """Show it while its action is offered and can be seen."""
        self._offered = offered
        self.setVisible(offered and self._action.isVisible())

    def _follow(self) -> None:
        action = self._action
        self.setText(action.text())
        self.setEnabled(action.isEnabled())
        self.setVisible(self._offered and action.isVisible())
        key = action.shortcut().toString()
        tip = action.toolTip() or action.text()
        self.setToolTip(f"{tip} ({key})" if key else tip)
        self.setAccessibleName(action.text())
        self._draw(str(action.property("drawing") or ""))

    def _draw(self, name: str) -> None:
        """Show a drawing, made anew only where it would look different: an action changes often, its drawing hardly."""
        shown, dim = self._theme.colour("on_accent" if self.main else "text"), self._theme.colour("text_dim")
        drawn = (name, shown.name(), dim.name())
        if name and drawn != self._drawn:
            self._drawn = drawn
            self.setIcon(icons.icon(name, shown, dim))
            self.setIconSize(QSize(20, 20))


class ActionBar(Worded, QWidget):
    """Shows the hint and actions of the page in view, the last message, and the job that runs.

    Attributes:
        closed_message: the operator put a message away.
    """

    closed_message = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._page: StepPage | None = None
        self._message: Message | None = None
        self._standing: Message | None = None
        self._task: Task[object] | None = None
        self.setProperty("role", "bar")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._icon, self._text, self._detail = QLabel(self), QLabel(self), QLabel(self)
        self._bar = QProgressBar(self)
        self._do = QPushButton(self)
        self._close = QPushButton(self)
        self._cancel = QPushButton(self)
        self._timer = QTimer(self, singleShot=True, interval=SHOWN_MS)
        self._buttons: dict[QAction, ActionButton] = {}
        self._lay_out()
        self._timer.timeout.connect(self._forget)
        self._close.clicked.connect(self._put_away)
        self._do.clicked.connect(self._act)
        self._cancel.clicked.connect(self._cancel_task)
        theme.changed.connect(self._show)
        self._say_words()
        self._show()

    def _lay_out(self) -> None:
        self._text.setWordWrap(True)
        self._detail.setWordWrap(True)
        self._detail.setProperty("role", "dim")
        self._icon.setFixedSize(ICON_PX, ICON_PX)
        self._bar.setTextVisible(False)
        self._bar.setRange(0, STEPS)
        for button in (self._do, self._close, self._cancel):
            button.setProperty("role", "quiet")
        words = QVBoxLayout()
        words.setSpacing(2)
        words.addStretch()
        words.addWidget(self._text)
        words.addWidget(self._detail)
        words.addWidget(self._bar)
        words.addStretch()
        self._actions = QHBoxLayout()
        self._actions.setSpacing(GRID)
        row = QHBoxLayout()
        row.setContentsMargins(3 * GRID, GRID, 2 * GRID, GRID)
        row.setSpacing(2 * GRID)
        row.addWidget(self._icon)
        row.addLayout(words, 1)
        for button in (self._do, self._close, self._cancel):
            row.addWidget(button)
        row.addLayout(self._actions)
        line = QFrame(self)
        line.setProperty("role", "hairline")
        line.setFixedHeight(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(line)
        column.addLayout(row)
        self.setMinimumHeight(72)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)

    def prepare(self, page: StepPage) -> None:
        """Make the buttons of what a page offers now, before it is first shown."""
        for action in (*page.other_actions, page.main_action):
            if action is not None:
                self._button(action, main=action is page.main_action)

    def follow(self, page: StepPage) -> None:
        """Show a page's hint and actions from now on."""
        if self._page is not None:
            self._page.hint_changed.disconnect(self._show)
            self._page.actions_changed.disconnect(self._show_actions)
        self._page = page
        page.hint_changed.connect(self._show)
        page.actions_changed.connect(self._show_actions)
        self._show_actions()
        self._show()

    def say(self, message: Message) -> None:
        """Show a message in the place of the hint; a lesser one does not push a standing one away."""
        standing = self._message is not None and self._message.stays
        if standing and not message.stays:
            return
        self._message = message
        self._timer.stop()
        if not message.stays:
            self._timer.start()
        self._show()

    def stand(self, message: Message | None) -> None:
        """Show what holds now wherever nothing else is said, until another or None is given."""
        self._standing = message
        self._show()

    def show_task(self, task: Task[object]) -> None:
        """Show a job's progress until it ends, or another one is shown; what an earlier one did is old news then."""
        if self._task is task:
            return
        if self._message is not None and not self._message.stays and not self._message.action:
            self._message = None
        if self._task is not None:
            self._task.progressed.disconnect(self._show_progress)
            self._task.ended.disconnect(self._task_ended)
        self._task = task
        self._bar.setValue(round(task.share * STEPS))
        task.progressed.connect(self._show_progress)
        task.ended.connect(self._task_ended)
        self._show()

    def _say_words(self) -> None:
        self._close.setText(self.tr("Close"))
        self._cancel.setText(self.tr("Stop"))
        self._cancel.setToolTip(self.tr("Stop this job; nothing is left half-done (Esc)"))
        self._cancel.setShortcut(Qt.Key.Key_Escape)
        self._close.setToolTip(self.tr("Put this message away"))
        self._show()

    def _level_word(self, level: Level) -> str:
        """Return what the icon says, for those who do not see it."""
        return {
            Level.INFO: self.tr("Information"), Level.GOOD: self.tr("Done"), Level.WARN: self.tr("Warning"),
            Level.BAD: self.tr("Error"),
        }[level]  # fmt: skip

    def _show(self) -> None:
        busy = self._task is not None
        message = self._message or (None if busy else self._standing)
        level = Level.INFO if message is None else message.level
        hint = "" if self._page is None else self._page.hint
        text = hint if message is None else message.what
        if message is None and busy and self._task is not None:
            text = self._task.name()
        self._text.setText(text)
        self._icon.setPixmap(
            icons.pixmap(level.value, self._theme.colour(_COLOURS[level]), ICON_PX, self.devicePixelRatioF())
        )
        self._icon.setAccessibleName(self._level_word(level))
        remedy = "" if message is None else message.remedy
        self._detail.setVisible(bool(remedy) or (busy and message is None))
        self._detail.setText(self._doing() if message is None else remedy)
        self._bar.setVisible(busy)
        self._cancel.setVisible(busy)
        self._close.setVisible(message is not None and message.stays)
        self._do.setVisible(message is not None and bool(message.action))
        self._do.setText("" if message is None else message.action)

    def _show_actions(self) -> None:
        """Show the buttons of the page's actions; each is made once, as dressing a new one takes milliseconds."""
        page = self._page
        main = None if page is None else page.main_action
        wanted = () if page is None else (*page.other_actions, *(() if main is None else (main,)))
        for button in self._buttons.values():
            self._actions.removeWidget(button)
        for action in wanted:
            self._actions.addWidget(self._button(action, main=action is main))
        for action, button in self._buttons.items():
            button.offer(action in wanted)

    def _button(self, action: QAction, *, main: bool) -> ActionButton:
        button = self._buttons.get(action)
        if button is None or button.main is not main:
            if button is not None:
                button.hide()
                button.deleteLater()
            button = self._buttons[action] = ActionButton(action, self._theme, main=main, parent=self)
        return button

    def _show_progress(self, share: float, _doing: str) -> None:
        self._bar.setValue(round(share * STEPS))
        if self._message is None:  # else its remedy stands there
            self._detail.setText(self._doing())

    def _doing(self) -> str:
        """Return what the job that runs is at."""
        if self._task is None:
            return ""
        return self.tr("Stopping …") if self._task.stopping else self._task.doing

    def _task_ended(self) -> None:
        self._task = None
        self._show()

    def _cancel_task(self) -> None:
        if self._task is not None:
            self._task.cancel()
            self._show()

    def _act(self) -> None:
        shown = self._message or self._standing
        act = None if shown is None else shown.act
        self._forget()
        if act is not None:
            act()

    def _put_away(self) -> None:
        self._forget()
        self.closed_message.emit()

    def _forget(self) -> None:
        self._timer.stop()
        self._message = None
        self._show()
