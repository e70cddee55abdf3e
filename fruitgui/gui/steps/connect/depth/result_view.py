"""What measuring came to: lengths typed, before and after, or why there is no correction."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QWidget

from fruitgui.calibration.depth.measured import DepthFit, DepthRefusal, Figure, Sureness
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.steps.connect.depth.reason_words import reason_words
from fruitgui.gui.steps.connect.depth.words import (
    figure_name,
    missing_texts,
    mm,
    sureness_name,
    terms_text,
    verdict_text,
)
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health

ICON_PX, TABLE_WIDTH = 32, 720


class ResultView(Card):
    """A verdict with a table of figures, or reasons with remedies."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._theme = theme
        self._sensor = ""
        self._outcome: DepthFit | DepthRefusal | None = None
        self._icon, self.word = QLabel(), label("", "page")
        self.sentence, self.terms, self.missing = label(""), label("", "small"), label("", "small")
        self._table, self._sureness = QGridLayout(), QGridLayout()
        self._lay_out()
        theme.changed.connect(self.draw)

    def show_outcome(self, sensor: str, outcome: DepthFit | DepthRefusal) -> None:
        """Show what measuring a sensor came to."""
        self._sensor, self._outcome = sensor, outcome
        self.draw()

    def draw(self) -> None:
        """Say it anew, in the language and the theme of now."""
        outcome = self._outcome
        if outcome is None:
            return
        good = isinstance(outcome, DepthFit)
        self._icon.setPixmap(
            icons.pixmap("good" if good else "bad", self._theme.colour("good" if good else "bad"), ICON_PX)
        )
        text = self.tr("The depth of {sensor} can be corrected") if good else self.tr("This does not do yet: {sensor}")
        self.word.setText(text.format(sensor=self._sensor))
        self._clear()
        for one in (self.sentence, self.terms, self.missing):
            one.clear()
        if isinstance(outcome, DepthFit):
            self._show_fit(outcome)
        else:
            self._show_reasons(outcome)
        for one in (self.sentence, self.terms, self.missing):
            one.setVisible(bool(one.text()))

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.setSpacing(GRID)
        self._icon.setFixedSize(QSize(ICON_PX, ICON_PX))
        head.addWidget(self._icon)
        head.addWidget(self.word, 1)
        for one in (self.sentence, self.terms, self.missing):
            one.setWordWrap(True)
        set_health(self.missing, "warn")
        self.body.setSpacing(2 * GRID)
        self.body.addLayout(head)
        self.body.addWidget(self.sentence)
        self.body.addWidget(_placed(self._table))
        self.body.addWidget(self.terms)
        self.body.addWidget(_placed(self._sureness))
        self.body.addWidget(self.missing)
        self.body.addStretch()

    def _clear(self) -> None:
        for table in (self._table, self._sureness):
            while table.count():
                item = table.takeAt(0)
                widget = None if item is None else item.widget()
                if widget is not None:
                    widget.hide()
                    widget.deleteLater()

    def _show_fit(self, fit: DepthFit) -> None:
        self.sentence.setText(verdict_text(fit))
        self.terms.setText(self.tr("Fitted: {terms}.").format(terms=terms_text(fit)))
        self.missing.setText("\n".join(missing_texts(fit)))
        heads = ("", self.tr("typed"), self.tr("before"), self.tr("after"))
        for column, text in enumerate(heads):
            self._table.addWidget(label(text, "dim"), 0, column, Qt.AlignmentFlag.AlignRight)
        for row, figure in enumerate(fit.figures, start=1):
            self._add_figure(row, figure)
        heads = (self.tr("Known by"), self.tr("scale"), self.tr("offset"), self.tr("depth at the belt"))
        heights = 1 + sum(one.what in ("height", "raised") for one in fit.figures)
        for column, text in enumerate(heads):
            side = Qt.AlignmentFlag.AlignRight if column else Qt.AlignmentFlag.AlignLeft
            self._sureness.addWidget(label(text, "dim"), 0, column, side)
        for row, one in enumerate(fit.sureness, start=1):
            self._add_sureness(row, one, heights)

    def _add_figure(self, row: int, figure: Figure) -> None:
        right = Qt.AlignmentFlag.AlignRight
        self._table.addWidget(label(figure_name(figure.what)), row, 0)
        typed = "" if figure.what == "flatness" else mm(figure.typed_m, 1)
        self._table.addWidget(label(typed), row, 1, right)
        self._table.addWidget(label(mm(figure.before_m, 1), "dim"), row, 2, right)
        after = label(mm(figure.after_m, 1), "strong")
        set_health(after, "good" if _better(figure) else "")
        self._table.addWidget(after, row, 3, right)

    def _add_sureness(self, row: int, known: Sureness, heights: int) -> None:
        role = "strong" if known.by == "all" else ""
        self._sureness.addWidget(label(sureness_name(known.by, heights), role), row, 0)
        values = (
            f"±{number_text(196.0 * known.scale_std, 2)}{THIN}%",
            f"±{mm(1.96 * known.offset_std_m, 1)}",
            f"±{mm(1.96 * known.depth_std_m, 1)}",
        )
        for column, text in enumerate(values, start=1):
            self._sureness.addWidget(label(text, role), row, column, Qt.AlignmentFlag.AlignRight)

    def _show_reasons(self, refusal: DepthRefusal) -> None:
        for row, reason in enumerate(refusal.reasons):
            what, remedy = reason_words(reason)
            said, done = label(what, "strong"), label(remedy)
            for one in (said, done):
                one.setWordWrap(True)
            self._table.addWidget(said, 2 * row, 0, 1, 4)
            self._table.addWidget(done, 2 * row + 1, 0, 1, 4)


def _placed(table: QGridLayout) -> QWidget:
    """Return the place of a table whose first column takes what room is left."""
    table.setHorizontalSpacing(4 * GRID)
    table.setVerticalSpacing(GRID)
    table.setColumnStretch(0, 1)
    table.setContentsMargins(0, 0, 0, 0)
    place = QWidget()
    place.setMaximumWidth(TABLE_WIDTH)
    place.setLayout(table)
    return place


def _better(figure: Figure) -> bool:
    return abs(figure.after_m - figure.typed_m) < abs(figure.before_m - figure.typed_m)
