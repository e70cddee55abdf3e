"""The training screen."""

from __future__ import annotations

from PySide6.QtCore import QEvent
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QStackedLayout, QVBoxLayout, QWidget

from fruitgui.gui.kind_words import kinds_in_order
from fruitgui.gui.session import Session
from fruitgui.gui.step_words import reason_text
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.steps.train.result_panel import ResultPanel
from fruitgui.gui.steps.train.start_panel import StartPanel
from fruitgui.gui.steps.train.trainer import Trainer
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import EmptyPlace
from fruitgui.station.workflow import KINDS_NEEDED, Step


class TrainPage(StepPage):
    """Train, look, accept or keep the old; or roll back."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.trainer = Trainer(session, self)
        self.empty = EmptyPlace(theme, "train")
        self.start, self.result = StartPanel(theme), ResultPanel(theme, session.store.crops)
        self.train, self.accept, self.discard, self.back = (QAction(self) for _ in range(4))
        self.look = QAction(self)
        self._shown: object = None
        self._stack = QStackedLayout()
        for one in (self.empty, self.start, self.result):
            self._stack.addWidget(one)
        column = QVBoxLayout(self)
        column.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        column.addLayout(self._stack)
        self._say_words()
        self._connect()
        self.trainer.load()
        self._show()

    def entered(self) -> None:
        """Show what is taught now."""
        self.trainer.load()
        self._show()

    def left(self) -> None:
        """Rest; training goes on."""
        self.result.mistakes.model.rest()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._show()
        super().changeEvent(event)

    def _connect(self) -> None:
        self.trainer.changed.connect(self._show)
        self._session.states_changed.connect(self._show)
        self._session.station_changed.connect(self._show)
        self.train.triggered.connect(self.trainer.train)
        self.accept.triggered.connect(self.trainer.accept)
        self.discard.triggered.connect(self.trainer.discard)
        self.back.triggered.connect(self.trainer.roll_back)
        self.look.triggered.connect(self._look_at_chosen)
        self.result.mistakes.wanted.connect(self._look_at)
        self.result.mistakes.chosen_changed.connect(self._show_actions)
        self.result.turned.connect(self._show_actions)
        self.result.mistakes.model.queries.failed.connect(self._session.messages.error)

    def _say_words(self) -> None:
        for action, text, tip, drawing, key in (
            (self.train, self.tr("Train"), self.tr("Learn from all fruit that have a kind"), "train", "Ctrl+R"),
            (self.accept, self.tr("Accept"), self.tr("Name fruit with the new model from now on"), "save",
             "Ctrl+Return"),
            (self.discard, self.tr("Keep the old"), self.tr("Put the new model away"), "delete", "Ctrl+Backspace"),
            (self.back, self.tr("Roll back"), self.tr("Go back to the model that was in use before"), "undo",
             "Ctrl+B"),
            (self.look, self.tr("Look at its label"), self.tr("Go to this fruit on the screen “Teach”"), "teach",
             "Ctrl+L"),
        ):  # fmt: skip
            action.setText(text)
            action.setToolTip(tip)
            action.setProperty("drawing", drawing)
            action.setShortcut(QKeySequence(key))

    # what is shown

    def _marks(self) -> dict[str, KindMark]:
        taught = self._session.taught
        return self._session.looks(kinds_in_order(self._session.marks.kinds, () if taught is None else taught.kinds))

    def _show(self) -> None:
        taught, trained = self._session.taught, self.trainer.trained
        if trained is not None:
            if trained is not self._shown:
                self._shown = trained
                self.result.show_trained(trained, self._marks())
                self.result.turn_to("kinds")
            self._stack.setCurrentWidget(self.result)
        elif taught is not None and taught.kinds:
            self._shown = None
            self.start.show_taught(taught, self._marks())
            station = self._session.station
            remark = reason_text(self._session.states()[Step.TRAIN])
            in_use = None if station is None else station.model
            if not self.trainer.versions and in_use is None:
                remark = self.tr("None yet: every fruit counts as unknown until one is trained and accepted.")
            self.start.show_versions(self.trainer.versions, in_use, remark)
            self.start.show_waiting(self.trainer.waiting)
            self._stack.setCurrentWidget(self.start)
        else:
            self.empty.show_words(
                self.tr("Nothing to learn from yet"),
                self.tr("Give fruit their kinds on the screen “Teach”; training then makes the model that names them, "
                        "and says here how good it is."),
            )  # fmt: skip
            self._stack.setCurrentWidget(self.empty)
        self._show_actions()

    def _show_actions(self) -> None:
        trainer, session = self.trainer, self._session
        busy = trainer.busy
        self.train.setEnabled(not busy and self._kinds() >= KINDS_NEEDED)
        self.accept.setEnabled(not busy and session.station is not None)
        self.discard.setEnabled(not busy)
        self.back.setEnabled(not busy and len(trainer.versions) > 1)
        shown = self._stack.currentWidget()
        had = session.station is not None and session.station.model is not None
        self.discard.setText(self.tr("Keep the old") if had else self.tr("Put away"))
        if shown is self.result:
            mistakes = self.result.shown == "mistakes" and self.result.mistakes.chosen is not None
            main = self.accept if session.station is not None else self.way_to(Step.CALIBRATE)
            self.offer(main, *((self.look,) if mistakes else ()), self.train, self.discard)
        elif shown is self.empty or (self._kinds() < KINDS_NEEDED and trainer.waiting is None):
            self.offer(self.way_to(Step.TEACH), *((self.back,) if len(trainer.versions) > 1 else ()))
        else:
            back = (self.back,) if len(trainer.versions) > 1 else ()
            if trainer.waiting is not None:
                main = self.accept if session.station is not None else self.way_to(Step.CALIBRATE)
                self.offer(main, self.train, self.discard)
            else:
                live, teach = self.way_to(Step.LIVE), self.way_to(Step.TEACH)
                self.offer(*((live, *back, self.train) if self._up_to_date() else (self.train, *back, teach)))
        self.train.setText(self.tr("Train again") if shown is self.result or trainer.versions else self.tr("Train"))
        self.say(self._advice(shown))

    def _kinds(self) -> int:
        """Return how many kinds are taught."""
        return 0 if self._session.taught is None else len(self._session.taught.kinds)

    def _up_to_date(self) -> bool:
        """Whether the model in use was trained on what is taught now."""
        facts = self._session.facts()
        return facts.model is not None and facts.taught is not None and facts.model.taught == facts.taught.fingerprint

    def _advice(self, shown: QWidget | None) -> str:
        if self.trainer.busy:
            return self.tr("This takes some seconds to minutes; other screens can be used meanwhile.")
        if self._session.station is None and (shown is self.result or self.trainer.waiting is not None):
            return self.tr("Without a calibration the model cannot be taken into use.")
        if shown is self.empty:
            return self.tr("Teach at least two kinds first.")
        if shown is self.start:
            if self.trainer.waiting is None and self._kinds() < KINDS_NEEDED:
                return self.tr("Teach at least two kinds first.")
            if self.trainer.waiting is not None:
                return self.tr("A model waits since before: accept it, keep the old one, or train again to see more.")
            if self._up_to_date():
                return self.tr("The model in use knows everything that is taught.")
            return self.tr("Press Train; nothing changes on the line until the new model is accepted.")
        if self.trainer.trained is not None and self.trainer.trained.rivals is None:
            return self.tr("Look at the kinds and the mistakes, then accept the model.")
        return self.tr("Compare, then accept the new model or keep the old one.")

    def _look_at_chosen(self) -> None:
        key = self.result.mistakes.chosen
        if key is not None:
            self._look_at(key)

    def _look_at(self, key: int) -> None:
        self.step_wanted.emit(Step.TEACH)
        self._session.taught_wanted.emit(key)
