"""The summary of a lot: figures, times, kinds, and how sizes are spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QScrollArea, QVBoxLayout, QWidget

from fruitgui.gui.numbers import count_text
from fruitgui.gui.steps.lots.figures import (
    LotFigures,
    Span,
    corrected_text,
    kind_rows,
    of_text,
    rate_text,
    spans,
    spell_texts,
    times_text,
    trouble_text,
    unseen_text,
)
from fruitgui.gui.steps.lots.kind_table import KindTable
from fruitgui.gui.steps.lots.spreads import Spreads
from fruitgui.gui.steps.lots.words import kilograms_text, litres_text
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.times import clock_text, duration_text
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.gui.widgets.reach import reach
from fruitgui.records.distribution import Distribution

TIMES_HEIGHT, BAND = 36, 12
SPREADS_HEIGHT, LOW_SPREADS_HEIGHT, LEAST_SPREADS_HEIGHT = 220, 150, 128
MOST_TOLD = 20
"""Times that a pointer's rest tells of, the longest."""

ROOMY = 560
"""Pixels of height from which on there is room for words that a pointer's rest tells as well."""


class Times(QWidget):
    """A lot's time from left to right: bars where it ran, gaps where it stood still."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._spans: Sequence[Span] = ()
        self.setFixedHeight(TIMES_HEIGHT)
        theme.changed.connect(self.update)

    def show_spans(self, parts: Sequence[Span]) -> None:
        """Show another lot's time."""
        if list(parts) != list(self._spans):
            self._spans = parts
            words = "\n".join(span.words for span in parts)
            self.setToolTip(words)
            self.setAccessibleName(words)
            self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        if not self._spans:
            return
        first_s, last_s = self._spans[0].from_s, self._spans[-1].to_s
        scale = self.width() / max(last_s - first_s, 1e-9)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setFont(self._theme.font("small"))
            for span in self._spans:
                box = QRectF((span.from_s - first_s) * scale, 0, max((span.to_s - span.from_s) * scale, 2.0), BAND)
                self._paint_span(painter, span, box)
            painter.setPen(self._theme.colour("text_dim"))
            below = QRectF(0, BAND + 2, self.width(), TIMES_HEIGHT - BAND - 2)
            painter.drawText(below, Qt.AlignmentFlag.AlignLeft, clock_text(first_s))
            painter.drawText(below, Qt.AlignmentFlag.AlignRight, clock_text(last_s))

    def _paint_span(self, painter: QPainter, span: Span, box: QRectF) -> None:
        colour = self._theme.colour("text_dim" if span.why else "accent")
        if span.why:
            painter.setPen(colour)
            painter.drawLine(QPointF(box.left() + 2, box.center().y()), QPointF(box.right() - 2, box.center().y()))
            text = duration_text(span.to_s - span.from_s)
            room = box.adjusted(0, BAND + 2, 0, TIMES_HEIGHT - BAND)
            if (
                QFontMetricsF(painter.font()).horizontalAdvance(text) < box.width()
                and 50 < box.left() < self.width() - 110
            ):
                painter.drawText(room, Qt.AlignmentFlag.AlignHCenter, text)
        else:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(colour)
            painter.drawRoundedRect(box, 3, 3)


class Figure(QWidget):
    """One figure with what it is, and a few words on it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.what, self.value, self.more = label("", "small"), label("", "title"), label("", "small")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for one in (self.what, self.value, self.more):
            column.addWidget(one)

    def show_words(self, what: str, value: str, more: str) -> None:
        """Show another figure."""
        self.what.setText(what)
        self.value.setText(value)
        self.more.setText(more)


class Summary(QScrollArea):
    """All of a lot at a glance; a small screen leaves words out before it lets the spread of sizes go out of view."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._figures: LotFigures | None = None
        self._marks: Mapping[str, KindMark] = {}
        self.kinds, self.times, self.spreads = KindTable(theme), Times(theme), Spreads(theme)
        self.fruit, self.volume, self.mass = Figure(), Figure(), Figure()
        self.when, self.note, self.unseen = label("", "small"), label("", "small"), label("", "small")
        for one in (self.when, self.note, self.unseen):
            one.setWordWrap(True)
        set_health(self.unseen, "warn")
        figures = QHBoxLayout()
        figures.setSpacing(5 * GRID)
        for figure in (self.fruit, self.volume, self.mass):
            figures.addWidget(figure)
        figures.addStretch()
        top, bottom = Card(), Card()
        top.body.addLayout(figures)
        top.body.addWidget(self.times)
        top.body.addWidget(self.unseen)
        top.body.addWidget(self.when)
        top.body.addWidget(self.kinds)
        bottom.body.addWidget(self.spreads, 1)
        bottom.body.addWidget(self.note)
        self._top, self._bottom = top, bottom
        inside = QWidget()
        inside.setProperty("role", "scrolled")
        self.setWidget(inside)
        self.setWidgetResizable(True)
        reach(self)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        column = QVBoxLayout(inside)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GRID)
        column.addWidget(top)
        column.addWidget(bottom, 1)

    def show_figures(self, figures: LotFigures, marks: Mapping[str, KindMark]) -> None:
        """Show another lot, or the same at another moment."""
        self._figures, self._marks = figures, marks
        self.kinds.show_rows(kind_rows(figures), marks)
        self.times.show_spans(spans(figures.lot, figures.now_s))
        self._say_words()

    def show_spread(self, spread: Distribution) -> None:
        """Show how a measure is spread."""
        self.spreads.show_spread(spread, self._marks)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Use the room."""
        super().resizeEvent(event)
        roomy = self.viewport().height() >= ROOMY
        for words in (self.when, self.note):
            words.setVisible(roomy)
        self._fit_words()

    def _fit_words(self) -> None:
        """Give words the height that they take at this width.

        Were it left to Qt, a scroll area whose height depends on its width would show and hide its scroll bar within
        one another until the stack is full.
        """
        width = self.viewport().width() - 4 * GRID - 2
        for words in (self.unseen, self.when, self.note):
            policy = words.sizePolicy()
            policy.setHeightForWidth(False)
            words.setSizePolicy(policy)
            words.setMinimumHeight(0)  # what was needed at another width would count
            words.setFixedHeight(max(words.heightForWidth(width), 0))
        self._fit_spreads()

    def _fit_spreads(self) -> None:
        """Let the spread of sizes be as high as it is best, and as low as it can be read before anything scrolls."""
        height = self.viewport().height()
        left = height - self._top.minimumSizeHint().height() - GRID
        best = SPREADS_HEIGHT if height >= ROOMY else LOW_SPREADS_HEIGHT
        self._bottom.setMinimumHeight(max(min(best, left), LEAST_SPREADS_HEIGHT))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange and self._figures is not None:
            self.show_figures(self._figures, self._marks)
        super().changeEvent(event)

    def _say_words(self) -> None:
        figures = self._figures
        if figures is None:
            return
        self.fruit.show_words(
            self.tr("Fruit"), count_text(figures.fruit), f"{rate_text(figures)} · {corrected_text(figures)}"
        )
        self.volume.show_words(
            self.tr("Total volume"), litres_text(figures.volume_m3), of_text(figures.measured, figures.fruit)
        )
        self.mass.show_words(
            self.tr("Total mass"), kilograms_text(figures.mass_kg),
            of_text(figures.weighed, figures.fruit) if figures.weighed else self.tr("no density is known"),
        )  # fmt: skip
        self.when.setText(times_text(figures.lot, figures.now_s))
        doubts = [text for text in (unseen_text(figures.lot, figures.now_s), trouble_text(figures.lot)) if text]
        self.unseen.setText(". ".join(doubts))
        self.unseen.setVisible(bool(doubts))
        told = spell_texts(figures.lot, figures.now_s, MOST_TOLD)
        self.unseen.setToolTip("\n".join(f"{when}, {lasted}: {what}" for when, lasted, what in told))
        note = self.tr(
            "± is half the width of a 95 % interval. In that of sums and means what single fruit err by averages out; "
            "what all err by together (the sensors' scale, a kind's correction) does not."
        )
        self.note.setText(note)
        for figure in (self.volume, self.mass):
            figure.setToolTip(note)
        self.fruit.setToolTip(self.when.text())
        self._fit_words()
