"""The table of a lot's fruit with what it is filtered by."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from PySide6.QtCore import QEvent, QModelIndex, QSize, Qt, Signal
from PySide6.QtGui import QIcon, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHBoxLayout,
    QHeaderView,
    QStackedWidget,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text
from fruitgui.gui.steps.lots.fruit_delegate import ROW, FruitDelegate
from fruitgui.gui.steps.lots.fruit_model import FruitModel
from fruitgui.gui.steps.lots.fruit_rows import COLUMNS, FALLS_FIRST, Column, Show, Wanted, show_word
from fruitgui.gui.steps.lots.paged_model import visible_rows
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import EmptyPlace, label
from fruitgui.gui.widgets.choice_box import ChoiceBox
from fruitgui.gui.widgets.kind_mark import mark_pixmap
from fruitgui.gui.widgets.reach import reach
from fruitgui.gui.widgets.worded import Worded
from fruitgui.records.fruit_record import FruitRecord

WIDTHS = {
    Column.PICTURE: 64, Column.NUMBER: 64, Column.SURE: 64, Column.VOLUME: 118, Column.MASS: 112, Column.DIAMETER: 118,
    Column.LENGTH: 118, Column.VIEWS: 70,
}  # fmt: skip
KIND_WIDTH, WIDEST_KIND = 160, 360
"""Pixels: in a wider column a figure is too far from its kind's name to be read with it."""

WIDEST_FIGURES = 1.5
"""Times their width, where there is room."""

FIRST_TO_GO = (Column.VIEWS, Column.LENGTH, Column.MASS)
"""Columns that are hidden, in this order, where there is no room; a fruit that is opened shows them all."""


class FruitTable(Worded, QWidget):
    """Filters over the table.

    Attributes:
        wanted_changed: other fruit are to be shown; see `wanted`.
        opened: the number of a row that is to be shown large.
        chosen_changed: other rows are chosen.
    """

    wanted_changed = Signal()
    opened = Signal(int)
    chosen_changed = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._wanted = Wanted(0)
        self.model = FruitModel()
        self.view, self.show_box, self.kind_box = QTableView(), ChoiceBox(), ChoiceBox()
        self.found = label("", "dim")
        self._delegate = FruitDelegate(theme, self.view)
        self._empty, self._stack = EmptyPlace(theme, "search"), QStackedWidget()
        self._lay_out()
        self._connect()
        self._say_words()

    @property
    def wanted(self) -> Wanted:
        """Which fruit are shown, in which order."""
        return self._wanted

    def show_lot(self, lot: int) -> None:
        """Show another lot's fruit, filtered and sorted as before."""
        self._want(Wanted(lot, self._wanted.show, None, self._wanted.column, self._wanted.falling))
        self.kind_box.setCurrentIndex(0)

    def show_kinds(self, kinds: Sequence[str], marks: Mapping[str, KindMark]) -> None:
        """Offer these kinds to filter by, with these marks."""
        self._delegate.marks = marks
        self.view.viewport().update()
        there = [self.kind_box.itemData(number) for number in range(1, self.kind_box.count())]
        if there == list(kinds):
            return
        chosen = self.kind_box.currentData()
        self.kind_box.blockSignals(True)
        while self.kind_box.count() > 1:
            self.kind_box.removeItem(1)
        for kind in kinds:
            self.kind_box.addItem(QIcon(mark_pixmap(marks[kind], 40)), kind_name(kind), kind)
        self.kind_box.setCurrentIndex(max(self.kind_box.findData(chosen), 0))
        self.kind_box.blockSignals(False)

    def chosen(self) -> list[FruitRecord]:
        """Return the fruit of the rows that are chosen."""
        rows = sorted({index.row() for index in self.view.selectionModel().selectedRows()})
        return [fruit for fruit in map(self.model.pages.row, rows) if fruit is not None]

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Hide columns that there is no room for, and fill what came into view."""
        super().resizeEvent(event)
        self._fit_columns()
        self._look()

    def eventFilter(self, _watched: object, event: Any) -> bool:  # noqa: N802, ANN401 - Qt's name
        """Open a fruit with the keyboard."""
        if event.type() == QEvent.Type.KeyPress and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._open(self.view.currentIndex())
            return True
        return False

    def _lay_out(self) -> None:
        view = self.view
        view.setModel(self.model)
        view.setItemDelegate(self._delegate)
        reach(view)
        view.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        view.setShowGrid(False)
        view.setTabKeyNavigation(False)
        view.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        view.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        view.verticalHeader().hide()
        view.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        view.verticalHeader().setDefaultSectionSize(ROW)
        head = view.horizontalHeader()
        head.setMinimumHeight(44)
        head.setHighlightSections(False)
        head.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        head.setSectionsClickable(True)
        for show in Show:
            self.show_box.addItem("", show)
        self.kind_box.addItem("", None)
        self.kind_box.setIconSize(QSize(20, 20))
        for box in (self.show_box, self.kind_box):
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        bar = QHBoxLayout()
        bar.setSpacing(GRID)
        bar.addWidget(self.show_box)
        bar.addWidget(self.kind_box)
        bar.addStretch()
        bar.addWidget(self.found)
        self._stack.addWidget(view)
        self._stack.addWidget(self._empty)
        column_ = QVBoxLayout(self)
        column_.setContentsMargins(0, 0, 0, 0)
        column_.setSpacing(GRID)
        column_.addLayout(bar)
        column_.addWidget(self._stack, 1)

    def _connect(self) -> None:
        self.view.horizontalHeader().sectionClicked.connect(self._sort)
        self.view.verticalScrollBar().valueChanged.connect(self._look)
        self.view.doubleClicked.connect(self._open)
        self.view.clicked.connect(self._pressed)
        self.view.installEventFilter(self)
        self.view.selectionModel().selectionChanged.connect(self.chosen_changed)
        self.show_box.currentIndexChanged.connect(self._filter)
        self.kind_box.currentIndexChanged.connect(self._filter)
        self.model.taken.connect(self._taken)
        self._theme.changed.connect(self.view.viewport().update)

    def _say_words(self) -> None:
        for number, show in enumerate(Show):
            self.show_box.setItemText(number, show_word(show))
        self.kind_box.setItemText(0, self.tr("All kinds"))
        for number in range(1, self.kind_box.count()):
            self.kind_box.setItemText(number, kind_name(self.kind_box.itemData(number)))
        self.show_box.setAccessibleName(self.tr("Which fruit"))
        self.show_box.setToolTip(self.tr("Which fruit are shown"))
        self.kind_box.setAccessibleName(self.tr("Kind"))
        self.kind_box.setToolTip(self.tr("Fruit of which kind are shown"))
        self.view.setAccessibleName(self.tr("Fruit of the lot; Return opens one, keys 1 to 9 name it"))
        self._empty.show_words(self.tr("No such fruit"), self.tr("Choose other fruit or another kind above."))
        self._show_found()

    def _fit_columns(self) -> None:
        room = self.view.viewport().width() - KIND_WIDTH - sum(WIDTHS.values())
        for column in FIRST_TO_GO:
            hidden = room < 0
            self.view.setColumnHidden(COLUMNS.index(column), hidden)
            room += WIDTHS[column] if hidden else 0
        head, kind = self.view.horizontalHeader(), min(KIND_WIDTH + max(room, 0), WIDEST_KIND)
        shown = sum(width for column, width in WIDTHS.items() if not self.view.isColumnHidden(COLUMNS.index(column)))
        wider = min(max((self.view.viewport().width() - kind) / shown, 1.0), WIDEST_FIGURES)
        head.resizeSection(COLUMNS.index(Column.KIND), kind)
        for column, width in WIDTHS.items():
            head.resizeSection(COLUMNS.index(column), width if column is Column.PICTURE else int(width * wider))

    def _sort(self, section: int) -> None:
        column, now = COLUMNS[section], self._wanted
        if column.order is not None:
            falling = not now.falling if column is now.column else column in FALLS_FIRST
            self._want(Wanted(now.lot, now.show, now.kind, column, falling))

    def _filter(self) -> None:
        now, show = self._wanted, Show(self.show_box.currentData())
        self.kind_box.setEnabled(show is not Show.UNKNOWN)
        self._want(Wanted(now.lot, show, self.kind_box.currentData(), now.column, now.falling))

    def _want(self, wanted: Wanted) -> None:
        if wanted != self._wanted:
            self._wanted = wanted
            self.model.show_order(wanted.column, falling=wanted.falling)
            self.wanted_changed.emit()

    def _pressed(self, index: QModelIndex) -> None:
        """Open a fruit at a press on its picture: two quick ones are hard with gloves."""
        if COLUMNS[index.column()] is Column.PICTURE:
            self._open(index)

    def _open(self, index: QModelIndex) -> None:
        if index.isValid():
            self.opened.emit(index.row())

    def _taken(self) -> None:
        self._show_found()
        if self.model.pages.found and not self.view.currentIndex().isValid():
            self.view.setCurrentIndex(self.model.index(0, 0))
        self._look()

    def _show_found(self) -> None:
        count = self.model.pages.found
        self.found.setText(self.tr("{count} fruit").format(count=count_text(count)))
        self._stack.setCurrentIndex(0 if count else 1)

    def _look(self) -> None:
        if self.model.pages.found:
            self.model.look(*visible_rows(self.view))
