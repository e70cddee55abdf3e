"""The list of lots: searched by words and dates, the newest first."""

from __future__ import annotations

from datetime import date
from typing import Any

from PySide6.QtCore import QDate, QModelIndex, QPoint, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QResizeEvent
from PySide6.QtWidgets import (
    QDateEdit,
    QHBoxLayout,
    QLineEdit,
    QListView,
    QStackedWidget,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolButton,
    QWidget,
)

from fruitgui.gui.numbers import count_text
from fruitgui.gui.steps.lots.lot_entry import LotEntry, LotState, Period, bounds_s, state_word
from fruitgui.gui.steps.lots.paged_model import Index, PagedModel, visible_rows
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.gui.widgets.cards import Card, EmptyPlace, label
from fruitgui.gui.widgets.choice_box import ChoiceBox
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.reach import reach
from fruitgui.gui.widgets.worded import Worded

ROW = 84
TYPED_MS = 200
"""So long after the last letter the search begins."""

ENTRY = Qt.ItemDataRole.UserRole
STATE_LOOKS = {
    LotState.RUNNING: ("play", "good"), LotState.PAUSED: ("pause", "warn"), LotState.OPEN: ("warn", "warn"),
    LotState.ENDED: ("done", "text_dim"),
}  # fmt: skip


class LotModel(PagedModel[LotEntry]):
    """The lots that were found."""

    def __init__(self) -> None:
        super().__init__(1)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:  # noqa: ANN401 - Qt's
        """Return what is read aloud, or the entry itself."""
        entry = self.pages.row(index.row())
        if entry is None or role not in (ENTRY, Qt.ItemDataRole.AccessibleTextRole, Qt.ItemDataRole.DisplayRole):
            return None
        if role == ENTRY:
            return entry
        return ", ".join((entry.name, entry.who, entry.when, entry.fruit, entry.litres, state_word(entry.state)))


class LotDelegate(QStyledItemDelegate):
    """Paints a lot in three lines."""

    def __init__(self, theme: Theme, view: QListView) -> None:
        super().__init__(view)
        self._theme = theme
        self._view = view

    def sizeHint(self, _option: QStyleOptionViewItem, _index: Index) -> QSize:  # noqa: N802 - Qt's name
        """Return the size of a row."""
        return QSize(200, ROW)

    def paint(self, painter: QPainter, option: Any, index: Index) -> None:  # noqa: ANN401 - its fields are not typed
        """Draw one lot."""
        entry = index.data(ENTRY)
        box = QRectF(option.rect).adjusted(2, 2, -2, -2)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        if chosen:
            painter.setBrush(self._theme.colour("raised"))
            painter.setPen(self._theme.colour("accent" if self._view.hasFocus() else "line"))
            painter.drawRoundedRect(box, RADIUS - 2, RADIUS - 2)
        if chosen:
            painter.fillRect(QRectF(box.left(), box.top() + 14, 3, box.height() - 28), self._theme.colour("accent"))
        if isinstance(entry, LotEntry):
            self._write(painter, entry, box.adjusted(1.5 * GRID, GRID, -1.5 * GRID, -GRID))
        painter.restore()

    def _write(self, painter: QPainter, entry: LotEntry, box: QRectF) -> None:
        theme, third = self._theme, box.height() / 3
        lines = [QRectF(box.left(), box.top() + number * third, box.width(), third) for number in range(3)]
        icon, colour = STATE_LOOKS[entry.state]
        used = self._pair(painter, lines[0], state_word(entry.state), colour, icon)
        painter.setFont(theme.font("body", QFont.Weight.DemiBold))
        self._left(painter, lines[0].adjusted(0, 0, -used - GRID, 0), entry.name, "text")
        painter.setFont(theme.font("small"))
        used = self._pair(painter, lines[1], entry.when, "text_dim")
        self._left(painter, lines[1].adjusted(0, 0, -used - GRID, 0), entry.who, "text_dim")
        self._pair(painter, lines[2], entry.litres, "text")
        self._left(painter, lines[2], self.tr("{fruit} fruit").format(fruit=entry.fruit), "text")

    def _left(self, painter: QPainter, box: QRectF, text: str, colour: str) -> None:
        painter.setPen(self._theme.colour(colour))
        text = fitted(painter, text, box.width())
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)

    def _pair(self, painter: QPainter, box: QRectF, text: str, colour: str, icon: str = "") -> float:
        """Write something at the right, with an icon before it; return the room that it takes."""
        painter.setFont(self._theme.font("small"))
        painter.setPen(self._theme.colour(colour))
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, text)
        width = QFontMetricsF(painter.font()).horizontalAdvance(text)
        if icon:
            side = 16.0
            place = QRectF(box.right() - width - side - 4, box.center().y() - side / 2, side, side)
            icons.paint(painter, place, icon, self._theme.colour(colour))
            width += side + 4
        return width


class LotList(Worded, Card):
    """Search fields over the list.

    Attributes:
        searched: other words or dates.
        chosen: the key of a lot.
        store_wanted: where on the screen the menu of the store is to open.
    """

    searched = Signal()
    chosen = Signal(int)
    store_wanted = Signal(QPoint)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._theme = theme
        self.model = LotModel()
        self.words, self.period = QLineEdit(), ChoiceBox()
        self.first, self.last = QDateEdit(QDate.currentDate().addDays(-6)), QDateEdit(QDate.currentDate())
        self.view, self.store, self.found = QListView(), QToolButton(), label("", "small")
        self._empty = EmptyPlace(theme, "lots")
        self._stack = QStackedWidget()
        self._typed = QTimer(self, singleShot=True, interval=TYPED_MS)
        self._key: int | None = None
        self._lay_out()
        self._connect()
        self._say_words()
        self._draw()

    def bounds_s(self) -> tuple[float | None, float | None]:
        """Return from when to when lots are looked for."""
        chosen = (_python_date(self.first.date()), _python_date(self.last.date()))
        return bounds_s(Period(self.period.currentData()), date.today(), chosen)

    @property
    def narrowed(self) -> bool:
        """Whether not all lots are looked for."""
        return bool(self.words.text().strip()) or self.period.currentData() != Period.ANY

    def choose(self, key: int) -> None:
        """Mark a lot as chosen, where it is in the list."""
        self._key = key
        row = self.model.row_of(key)
        if row is not None and self.view.currentIndex().row() != row:
            self.view.setCurrentIndex(self.model.index(row, 0))

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Fill what came into view."""
        super().resizeEvent(event)
        self._look()

    def _lay_out(self) -> None:
        self.view.setModel(self.model)
        self.view.setItemDelegate(LotDelegate(self._theme, self.view))
        self.view.setUniformItemSizes(True)
        reach(self.view)
        self.view.setVerticalScrollMode(QListView.ScrollMode.ScrollPerPixel)
        self.view.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        for period in Period:
            self.period.addItem("", period)
        for field in (self.first, self.last):
            field.setCalendarPopup(False)
            field.setDisplayFormat("dd.MM.yyyy")
        dates, found = QHBoxLayout(), QHBoxLayout()
        for row in (dates, found):
            row.setSpacing(GRID)
        self.store.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        found.addWidget(self.found, 1)
        found.addWidget(self.store)
        dates.addWidget(self.first)
        dates.addWidget(self.last)
        self._stack.addWidget(self.view)
        self._stack.addWidget(self._empty)
        self.body.addWidget(self.words)
        self.body.addWidget(self.period)
        self.body.addLayout(dates)
        self.body.addLayout(found)
        self.body.addWidget(self._stack, 1)
        self._show_dates()

    def _connect(self) -> None:
        self.words.textChanged.connect(self._typed.start)
        self.words.returnPressed.connect(self.searched)
        self._typed.timeout.connect(self.searched)
        self.period.currentIndexChanged.connect(self._period_changed)
        for field in (self.first, self.last):
            field.dateChanged.connect(self._typed.start)
        self.view.selectionModel().currentChanged.connect(self._current_changed)
        self.view.verticalScrollBar().valueChanged.connect(self._look)
        self.model.taken.connect(self._taken)
        self.store.clicked.connect(self._open_store)
        self._theme.changed.connect(self._draw)

    def _say_words(self) -> None:
        texts = {
            Period.ANY: self.tr("At any time"),
            Period.TODAY: self.tr("Today"),
            Period.WEEK: self.tr("The last 7 days"),
            Period.MONTH: self.tr("The last 30 days"),
            Period.YEAR: self.tr("This year"),
            Period.CHOSEN: self.tr("Between two days"),
        }
        for number in range(self.period.count()):
            self.period.setItemText(number, texts[Period(self.period.itemData(number))])
        self.words.setPlaceholderText(self.tr("Search"))
        for field, name, tip in (
            (self.words, self.tr("Search"), self.tr("Words of a lot's name or grower (Ctrl+F)")),
            (self.period, self.tr("When"), self.tr("When the lots were started")),
            (self.first, self.tr("First day"), self.tr("The first day on which lots were started")),
            (self.last, self.tr("Last day"), self.tr("The last day on which lots were started")),
            (self.store, self.tr("Backup"), self.tr("Back up and restore all that is kept (Ctrl+B)")),
            (self.view, self.tr("Lots"), self.tr("The lots that were found, the newest first")),
        ):
            field.setAccessibleName(name)
            field.setToolTip(tip)
        self.store.setText(self.tr("Backup"))
        self.view.setToolTip("")
        self._show_found()

    def _draw(self) -> None:
        colour, dim = self._theme.colour("text"), self._theme.colour("text_dim")
        self.store.setIcon(icons.icon("disk", colour, dim))
        self.store.setIconSize(QSize(20, 20))
        self.view.viewport().update()

    def _show_found(self) -> None:
        count = self.model.pages.found
        one, more = self.tr("1 lot"), self.tr("{count} lots").format(count=count_text(count))
        self.found.setText((one if count == 1 else more) if count else "")
        if self.narrowed:
            what, how = self.tr("No lot was found"), self.tr("Search other words or another time.")
        else:
            what = self.tr("No lot yet")
            how = self.tr("Each lot that is started on the live screen appears here.")
        self._empty.show_words(what, how)
        self._stack.setCurrentIndex(0 if count else 1)

    def _show_dates(self) -> None:
        between = self.period.currentData() == Period.CHOSEN
        self.first.setVisible(between)
        self.last.setVisible(between)

    def _period_changed(self) -> None:
        self._show_dates()
        self.searched.emit()

    def _current_changed(self, index: QModelIndex) -> None:
        entry = index.data(ENTRY)
        if isinstance(entry, LotEntry) and entry.key != self._key:
            self._key = entry.key
            self.chosen.emit(entry.key)

    def _taken(self) -> None:
        self._show_found()
        if self._key is not None:
            self.choose(self._key)
        self._look()

    def _look(self) -> None:
        if self.model.pages.found:
            self.model.look(*visible_rows(self.view))

    def _open_store(self) -> None:
        self.store_wanted.emit(self.store.mapToGlobal(QPoint(0, self.store.height())))


def _python_date(day: QDate) -> date:
    return date(day.year(), day.month(), day.day())
