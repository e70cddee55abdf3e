"""The list of everything that can be connected, and the few choices that each has."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import (
    QAbstractButton,
    QHBoxLayout,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.steps.connect.offers import RECORDING, Offer, offers, supported_text
from fruitgui.gui.steps.connect.source_form import SourceForm
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.focus import paint_focus
from fruitgui.gui.widgets.scrolled import Scrolled
from fruitgui.station.recordings_made import MadeRecording
from fruitgui.station.sources import Source

ROW = 84
LIST_WIDTH = 420


class OfferRow(QAbstractButton):
    """One source: its icon, its name, and one line on it."""

    def __init__(self, offer: Offer, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.offer = offer
        self._theme = theme
        self.setCheckable(True)
        self.setAutoExclusive(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setText(offer.name)
        self.setAccessibleName(f"{offer.name}: {offer.what}")
        theme.changed.connect(self.update)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(LIST_WIDTH - 2 * GRID, ROW)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        painter, theme = QPainter(self), self._theme
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        chosen, box = self.isChecked(), QRectF(self.rect()).adjusted(1, 1, -1, -1)
        painter.setBrush(theme.colour("raised" if self.isChecked() or self.underMouse() else "surface"))
        painter.setPen(QPen(theme.colour("accent" if chosen else "edge"), 2.0 if chosen else 1.0))
        painter.drawRoundedRect(box, RADIUS, RADIUS)
        if self.hasFocus():
            paint_focus(painter, box, RADIUS, theme)
        middle = self.height() / 2
        icon = theme.colour("accent" if self.isChecked() else "text_dim")
        icons.paint(painter, QRectF(2 * GRID, middle - 14, 28, 28), self.offer.icon, icon)
        left = 7 * GRID
        width = self.width() - left - 2 * GRID
        wrapped = int(Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap)
        room = QRectF(left, 0, width, self.height())
        high = QFontMetricsF(theme.font("small")).boundingRect(room, wrapped, self.offer.what).height()
        top = middle - (3 * GRID + high) / 2
        painter.setPen(theme.colour("text"))
        painter.setFont(theme.font("body", QFont.Weight.DemiBold))
        painter.drawText(QRectF(left, top - 2, width, 3 * GRID), Qt.AlignmentFlag.AlignVCenter, self.offer.name)
        painter.setPen(theme.colour("text_dim"))
        painter.setFont(theme.font("small"))
        painter.drawText(QRectF(left, top + 3 * GRID, width, high), wrapped, self.offer.what)
        painter.end()


class SourceChooser(QWidget):
    """The list at the left, the choices of the chosen one at the right.

    Attributes:
        changed: another source is chosen, or it can be connected now or no longer.
        file_wanted: the person asks for a file of a recording.
    """

    changed = Signal()
    file_wanted = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._found: Sequence[Source] = ()
        self._rows: list[OfferRow] = []
        self._picked = ""
        self.form = SourceForm(theme)
        self._title, self._supported = label("", "page"), label("", "dim")
        self._supported.setWordWrap(True)
        self._list = QVBoxLayout()
        self._list.setSpacing(GRID)
        self._lay_out()
        self.form.changed.connect(self.changed)
        self.form.file_wanted.connect(self.file_wanted)

    @property
    def source(self) -> Source | None:
        """The source as chosen; None while something is missing."""
        return self.form.source

    @property
    def rows(self) -> tuple[OfferRow, ...]:
        """What is listed."""
        return tuple(self._rows)

    def show_found(self, found: Sequence[Source]) -> None:
        """List these sources, and a recording; a person's choice stays where it can."""
        self._found = found
        focused = any(row.hasFocus() for row in self._rows)
        for row in self._rows:
            self._list.removeWidget(row)
            row.hide()
            row.deleteLater()
        self._rows = [OfferRow(offer, self._theme) for offer in offers(found)]
        for row in self._rows:
            row.clicked.connect(self._pick)
            self._list.addWidget(row)
        wanted = next((row for row in self._rows if row.offer.key == self._picked), self._rows[0])
        wanted.setChecked(True)
        if focused:  # what was plugged in meanwhile takes nobody's place at the keyboard
            wanted.show()
            wanted.setFocus()
        self._title.setText(self.tr("What shall be connected?"))
        self._supported.setText(supported_text(found))
        self._choose()

    def update_found(self, found: Sequence[Source]) -> None:
        """List these sources where they are not those that are listed."""
        if list(found) != list(self._found):
            self.show_found(found)

    def take_file(self, path: Path) -> None:
        """Choose a recording's file."""
        row = next(row for row in self._rows if row.offer.key == RECORDING)
        row.setChecked(True)
        self._pick()
        self.form.take_file(path)

    def show_made(self, made: Sequence[MadeRecording]) -> None:
        """List the recordings that were made here."""
        self.form.show_made(made)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange and self._rows:
            self.show_found(self._found)
        super().changeEvent(event)

    def _lay_out(self) -> None:
        inner = QWidget()
        column = QVBoxLayout(inner)
        column.setContentsMargins(0, 0, GRID, 0)
        column.setSpacing(2 * GRID)
        column.addLayout(self._list)
        column.addWidget(self._supported)
        column.addStretch()
        scroll = Scrolled(inner)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        scroll.setFixedWidth(LIST_WIDTH)
        row = QHBoxLayout()
        row.setSpacing(3 * GRID)
        row.addWidget(scroll)
        row.addWidget(self.form, 1)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(2 * GRID)
        whole.addWidget(self._title)
        whole.addLayout(row, 1)

    def _pick(self) -> None:
        """Take what a person chose; before, sensors that are plugged in are chosen for them."""
        self._picked = next((row.offer.key for row in self._rows if row.isChecked()), "")
        self._choose()

    def _choose(self) -> None:
        chosen = next((row for row in self._rows if row.isChecked()), None)
        if chosen is not None:
            self.form.show_offer(chosen.offer)
            self._order_keys()
            self.changed.emit()

    def _order_keys(self) -> None:
        """Let the keyboard come to the list first, and then to what the chosen one asks, as they are read."""
        before: QWidget = self._rows[-1]
        for one in self.form.findChildren(QWidget):
            if one.focusPolicy() & Qt.FocusPolicy.TabFocus and one.window() is self.window():  # lists open in their own
                QWidget.setTabOrder(before, one)
                before = one
