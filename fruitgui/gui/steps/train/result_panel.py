"""After training: how good the model is, against the one in use, and what lies behind it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QButtonGroup, QGridLayout, QHBoxLayout, QPushButton, QStackedWidget, QVBoxLayout, QWidget

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import percent_text
from fruitgui.gui.steps.train import report
from fruitgui.gui.steps.train.matrix_view import MatrixView
from fruitgui.gui.steps.train.mistakes import MistakesView
from fruitgui.gui.steps.train.plots import CurvePlot, VolumePlot
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.records.crops import Crops
from fruitgui.records.training import Trained

TABS = ("kinds", "mistakes", "curve", "volume")
SIDE = 320


class ResultPanel(QWidget):
    """The verdict above; below it the kinds, the mistakes, the learning curve and the volumes.

    Attributes:
        turned: another of the four is shown.
    """

    turned = Signal()

    def __init__(self, theme: Theme, crops: Crops, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._trained: Trained | None = None
        self._marks: dict[str, KindMark] = {}
        self.figure, self.sentence, self.rivals = label("", "figure"), label(""), label("")
        self.matrix, self.mistakes = MatrixView(theme), MistakesView(crops, theme)
        self.curve, self.volume = CurvePlot(theme), VolumePlot(theme)
        self.curve_words, self.volume_words = label(""), label("")
        self.warnings, self.left_out = label("", "small"), label("", "small")
        self.densities = QGridLayout()
        self._density_title = label("", "strong")
        self.tabs = {name: QPushButton() for name in TABS}
        self._group = QButtonGroup(self)
        self._stack = QStackedWidget()
        self._lay_out()
        self._say_words()

    def show_trained(self, trained: Trained, marks: dict[str, KindMark]) -> None:
        """Show a model that was trained."""
        self._trained, self._marks = trained, marks
        training = trained.outcome.training
        right = training.confusion.right
        self.figure.setText(percent_text(right.value) if right.trials else "—")
        said, rivals = report.headline(training), report.comparison_text(trained.rivals)
        self.sentence.setText(said.text)
        set_health(self.figure, said.health)
        self.rivals.setText(rivals.text)
        self.rivals.setVisible(bool(rivals.text))
        set_health(self.rivals, rivals.health)
        self.matrix.show_matrix(report.matrix(training.confusion), marks)
        self.mistakes.show_trained(trained, marks)
        self.curve.show_curve(training.curve)
        self.curve_words.setText(report.curve_text(training.curve))
        self.warnings.setText("\n".join(report.warnings(trained.outcome.warnings)))
        self.warnings.setVisible(bool(trained.outcome.warnings))
        self._show_volume(trained)
        self._say_tabs()

    def turn_to(self, name: str) -> None:
        """Show one of the four."""
        self.tabs[name].setChecked(True)
        self._stack.setCurrentIndex(TABS.index(name))
        self.turned.emit()

    @property
    def shown(self) -> str:
        """Which of the four is shown."""
        return TABS[self._stack.currentIndex()]

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            if self._trained is not None:
                self.show_trained(self._trained, self._marks)
        super().changeEvent(event)

    def _show_volume(self, trained: Trained) -> None:
        words = report.volume_words(trained)
        self.volume.show_checks(trained.checks, self._marks)
        self.volume.setVisible(bool(trained.checks))
        self.volume_words.setText(words.text)
        self.left_out.setText(words.left_out)
        self._density_title.setVisible(bool(words.densities))
        while (item := self.densities.takeAt(0)) is not None:
            widget = item.widget()
            if widget is not None:
                widget.deleteLater()
        for row, (kind, density) in enumerate(words.densities):
            self.densities.addWidget(label(kind_name(kind)), row, 0)
            self.densities.addWidget(label(density, "dim"), row, 1)

    def _lay_out(self) -> None:
        for one in (self.sentence, self.rivals, self.curve_words, self.volume_words, self.warnings, self.left_out):
            one.setWordWrap(True)
        set_health(self.warnings, "warn")
        set_health(self.left_out, "warn")
        verdict = Card()
        row = QHBoxLayout()
        row.setSpacing(3 * GRID)
        words = QVBoxLayout()
        words.setSpacing(GRID // 2)
        words.addWidget(self.sentence)
        words.addWidget(self.rivals)
        row.addWidget(self.figure)
        row.addLayout(words, 1)
        verdict.body.addLayout(row)
        switch = QHBoxLayout()
        switch.setSpacing(GRID)
        for number, (name, button) in enumerate(self.tabs.items(), start=1):
            button.setCheckable(True)
            self._group.addButton(button)
            switch.addWidget(button)
            shortcut = QShortcut(QKeySequence(f"Ctrl+{number}"), self)
            shortcut.activated.connect(button.click)
            button.setProperty("tab", name)
        switch.addStretch()
        self._group.buttonClicked.connect(self._turn)
        for page in (self._kinds_page(), self.mistakes, self._curve_page(), self._volume_page()):
            self._stack.addWidget(page)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GRID)
        column.addWidget(verdict)
        column.addLayout(switch)
        column.addWidget(self._stack, 1)
        self.tabs["kinds"].setChecked(True)

    def _kinds_page(self) -> QWidget:
        card = Card()
        card.body.addWidget(self.matrix, 1)
        card.body.addWidget(self.warnings)
        return card

    def _curve_page(self) -> QWidget:
        card = Card()
        card.body.addWidget(self.curve_words)
        card.body.addWidget(self.curve, 1)
        return card

    def _volume_page(self) -> QWidget:
        card, side = Card(), QWidget()
        side.setFixedWidth(SIDE)
        column = QVBoxLayout(side)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2 * GRID)
        column.addWidget(self.volume_words)
        column.addWidget(self.left_out)
        column.addWidget(self._density_title)
        column.addLayout(self.densities)
        column.addStretch()
        row = QHBoxLayout()
        row.setSpacing(2 * GRID)
        row.addWidget(self.volume, 1)
        row.addWidget(side)
        card.body.addLayout(row)
        return card

    def _turn(self) -> None:
        self.turn_to(next(name for name, button in self.tabs.items() if button.isChecked()))

    def _say_words(self) -> None:
        self._density_title.setText(self.tr("Density, ± 95 % between fruit"))
        self._say_tabs()

    def _say_tabs(self) -> None:
        wrong = 0 if self._trained is None else len(self._trained.outcome.training.worst)
        words = {
            "kinds": self.tr("Kinds"),
            "mistakes": self.tr("Mistakes  {count}").format(count=wrong),
            "curve": self.tr("Learning curve"),
            "volume": self.tr("Volumes"),
        }
        for number, (name, button) in enumerate(self.tabs.items(), start=1):
            button.setText(words[name])
            button.setToolTip(f"{words[name]} (Ctrl+{number})")
