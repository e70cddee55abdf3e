"""The kinds as a row of large buttons that fill as they are taught, and a place to type another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPainterPath, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QGridLayout, QLineEdit, QSizePolicy, QWidget

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.steps.teach.desk import KindLine
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.focus import paint_focus
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.station.labels import LONGEST_KIND
from fruitgui.station.workflow import FRUIT_PER_KIND, SAMPLES_PER_KIND

HEIGHT = 68
NARROWEST = 140
MARK = 28
BAR = 5


class KindButton(QAbstractButton):
    """One kind: its key, its mark, its name, and how much of it is taught."""

    def __init__(self, line: KindLine, mark: KindMark, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self.line = line
        self.mark = mark
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setMinimumWidth(NARROWEST)
        theme.changed.connect(self.update)
        self.show_line(line, mark)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(NARROWEST, HEIGHT)

    def show_line(self, line: KindLine, mark: KindMark) -> None:
        """Show how far the kind is now."""
        self.line, self.mark = line, mark
        name = kind_name(line.kind)
        self.setText(name)
        self.setAccessibleName(f"{name}: {self.progress()}")
        tip = self.tr("Give this kind to the chosen fruit")
        if line.density_g_ml is not None:
            density = f"{number_text(line.density_g_ml, 2)}{THIN}g/ml"
            tip = self.tr("{tip}. Density by its reference fruit: {density}").format(tip=tip, density=density)
        self.setToolTip(f"{tip} ({line.key})" if line.key else tip)
        self.update()

    def progress(self) -> str:
        """Return how much is there of what is needed, in words."""
        if self.line.full:
            return self.tr("{samples} views · {fruit} fruit").format(samples=self.line.samples, fruit=self.line.fruit)
        return self.tr("{samples}/{views} views · {fruit}/{pieces} fruit").format(
            samples=self.line.samples, views=SAMPLES_PER_KIND, fruit=self.line.fruit, pieces=FRUIT_PER_KIND
        )

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        theme, box = self._theme, QRectF(self.rect()).adjusted(1, 1, -1, -1)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setBrush(theme.colour("line" if self.isDown() else "raised"))
            painter.setPen(QPen(theme.colour("accent" if self.underMouse() else "edge"), 1.0))
            painter.drawRoundedRect(box, GRID, GRID)
            left = QRectF(box.left() + GRID, box.top() + 0.75 * GRID, MARK, MARK)
            paint_mark(painter, left, self.mark)
            self._paint_key(painter, QRectF(left.center().x() - 10, left.bottom() + 4, 20, 18))
            words = QRectF(
                left.right() + GRID, box.top() + 4, box.right() - left.right() - 1.5 * GRID, box.height() - 12
            )
            self._paint_words(painter, words)
            self._paint_bar(painter, box)
            painter.setClipping(False)
            if self.hasFocus():
                paint_focus(painter, box, GRID, theme)

    def _paint_key(self, painter: QPainter, cap: QRectF) -> None:
        """Draw the key as a key."""
        if not self.line.key:
            return
        theme = self._theme
        painter.setPen(QPen(theme.colour("text_dim"), 1.0))
        painter.setBrush(theme.colour("surface"))
        painter.drawRoundedRect(cap, 4, 4)
        painter.setPen(theme.colour("text"))
        painter.setFont(theme.font("small", QFont.Weight.DemiBold))
        painter.drawText(cap, Qt.AlignmentFlag.AlignCenter, self.line.key)

    def _paint_words(self, painter: QPainter, box: QRectF) -> None:
        theme, foot = self._theme, 20.0
        painter.setFont(theme.font("small", QFont.Weight.DemiBold))
        painter.setPen(theme.colour("text"))
        name = box.adjusted(0, 0, 0, -foot)
        painter.drawText(name, int(Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextWordWrap), self.text())
        below = QRectF(box.left(), box.bottom() - foot, box.width(), foot)
        if self.line.full:
            icons.paint(painter, QRectF(below.right() - 18, below.top() + 1, 17, 17), "good", theme.colour("good"))
            below.setRight(below.right() - 20)
        painter.setFont(theme.font("small"))
        painter.setPen(theme.colour("text_dim"))
        words = QFontMetricsF(painter.font()).elidedText(self._short(), Qt.TextElideMode.ElideRight, below.width())
        painter.drawText(below, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, words)

    def _short(self) -> str:
        if self.line.full:
            return f"{self.line.samples} · {self.line.fruit}"
        return f"{self.line.samples}/{SAMPLES_PER_KIND} · {self.line.fruit}/{FRUIT_PER_KIND}"

    def _paint_bar(self, painter: QPainter, box: QRectF) -> None:
        whole = QPainterPath()
        whole.addRoundedRect(box.adjusted(1, 1, -1, -1), GRID, GRID)
        painter.setClipPath(whole)
        track = QRectF(box.left(), box.bottom() - BAR, box.width(), BAR)
        painter.fillRect(track, self._theme.colour("line"))
        colour = self._theme.colour("good" if self.line.full else "accent")
        painter.fillRect(QRectF(track.left(), track.top(), track.width() * self.line.share, BAR), colour)


class KindKeys(QWidget):
    """All kinds, in as many rows as are needed, and a field for a new one.

    Attributes:
        chosen: a kind was pressed.
        typed: the name of a new kind.
    """

    chosen = Signal(str)
    typed = Signal(str)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self.buttons: dict[str, KindButton] = {}
        self.new = QLineEdit()
        self.new.setMaxLength(LONGEST_KIND)
        self.new.setMinimumHeight(HEIGHT - 4)
        self.new.setClearButtonEnabled(True)
        self.new.returnPressed.connect(self._type)
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(GRID)
        self._columns = 0
        self._say_words()

    def show_lines(self, lines: Sequence[KindLine], marks: Mapping[str, KindMark]) -> None:
        """Show other kinds, or how far they are."""
        kinds = [line.kind for line in lines]
        if kinds != list(self.buttons):
            self._make(lines, marks)
        for line in lines:
            self.buttons[line.kind].show_line(line, marks.get(line.kind, UNKNOWN_MARK))

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Use the room."""
        super().resizeEvent(event)
        self._place()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            for button in self.buttons.values():
                button.show_line(button.line, button.mark)
        super().changeEvent(event)

    def _say_words(self) -> None:
        self.new.setPlaceholderText(self.tr("New kind …"))
        self.new.setAccessibleName(self.tr("Name of a new kind"))
        self.new.setToolTip(self.tr("Type a name and press Enter; the chosen fruit get it (Ctrl+K)"))

    def _make(self, lines: Sequence[KindLine], marks: Mapping[str, KindMark]) -> None:
        for button in self.buttons.values():
            self._grid.removeWidget(button)
            button.hide()
            button.deleteLater()
        self.buttons = {}
        for line in lines:
            button = KindButton(line, marks.get(line.kind, UNKNOWN_MARK), self._theme, self)
            button.clicked.connect(self._press)
            self.buttons[line.kind] = button
        self._columns = 0
        self._place()

    def _place(self) -> None:
        columns = max((self.width() + GRID) // (NARROWEST + GRID), 1)
        if columns == self._columns:
            return
        self._columns = columns
        for number, widget in enumerate([*self.buttons.values(), self.new]):
            self._grid.addWidget(widget, number // columns, number % columns)
        for column in range(self._grid.columnCount()):
            self._grid.setColumnStretch(column, 1 if column < columns else 0)

    def _press(self) -> None:
        pressed = self.sender()
        if isinstance(pressed, KindButton):
            self.chosen.emit(pressed.line.kind)

    def _type(self) -> None:
        name = self.new.text().strip()
        if name:
            self.new.clear()
            self.typed.emit(name)
