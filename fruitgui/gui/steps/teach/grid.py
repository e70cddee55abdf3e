"""The grid of large crops: colour with the outline; depth under the pointer, or of all at a key."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QItemSelectionModel, QPersistentModelIndex, QRectF, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPainterPath, QPen, QResizeEvent, QTransform
from PySide6.QtWidgets import QAbstractItemView, QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from fruitgui.gui.steps.teach.fruit_model import KEY, FruitModel, Index
from fruitgui.gui.steps.teach.tile import Tile, TileSource
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.view_pictures import ViewPictures
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.gui.widgets.reach import reach

SMALLEST, USUAL, LARGEST = 128, 192, 384
"""Pixels: side of a tile."""

FOOT, TWO_ROWS = 30, 42
"""Height of the words below: of one row, and of two where a name is too long for one."""

MARK = 22
PAPER = QColor(0, 0, 0, 150)
INK = QColor("#ffffff")


def paint_view(painter: QPainter, box: QRectF, view: ViewPictures | None, theme: Theme, *, depth: bool) -> None:
    """Draw one view of a fruit into a box, cut to fill it, with its outline."""
    painter.save()
    clip = QPainterPath()
    clip.addRoundedRect(box, GRID, GRID)
    painter.setClipPath(clip)
    painter.fillRect(box, theme.colour("picture"))
    picture = None if view is None else (view.depth if depth and not view.depth.isNull() else view.colour)
    if view is not None and picture is not None and not picture.isNull():
        scale = max(box.width() / picture.width(), box.height() / picture.height())
        middle = picture.rect().center()
        to_box = QTransform.fromTranslate(box.center().x(), box.center().y())
        to_box = to_box.scale(scale, scale).translate(-middle.x() - 0.5, -middle.y() - 0.5)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.setTransform(to_box, True)
        painter.drawImage(0, 0, picture)
        pen = QPen(QColor("#ffffff"), 1.5)
        pen.setCosmetic(True)
        painter.setPen(pen)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolygon(view.outline)
    painter.restore()


class TileDelegate(QStyledItemDelegate):
    """Paints one fruit."""

    def __init__(self, theme: Theme, tiles: TileSource, side: int, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._tiles = tiles
        self.side = side
        self.depth_of_all = False

    def sizeHint(self, _option: QStyleOptionViewItem, _index: Index) -> QSize:  # noqa: N802 - Qt's name
        """Return the size of a tile with the room around it."""
        return QSize(self.side + GRID, self.side + GRID)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Draw it."""
        model = index.model()
        if not isinstance(model, FruitModel):
            return
        state: QStyle.StateFlag = option.state
        rect: QRectF = QRectF(option.rect)
        half = GRID / 2
        box = rect.adjusted(half, half, -half, -half)
        key = int(index.data(KEY))
        views = model.views(key)
        depth = self.depth_of_all != bool(state & QStyle.StateFlag.State_MouseOver)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_view(painter, box, views[0] if views else None, self._theme, depth=depth)
        if views is not None and not views:
            self._paint_lack(painter, box)
        self._paint_foot(painter, box, self._tiles.tile(key))
        self._paint_frame(painter, box, state)
        painter.restore()

    def _paint_lack(self, painter: QPainter, box: QRectF) -> None:
        painter.setPen(self._theme.colour("text_dim"))
        painter.setFont(self._theme.font("small"))
        painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap), self.tr("No picture kept"))

    def _paint_foot(self, painter: QPainter, box: QRectF, tile: Tile) -> None:
        if tile.measured:
            disc = QRectF(box.right() - GRID / 2 - 26, box.top() + GRID / 2, 26, 26)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(PAPER)
            painter.drawEllipse(disc)
            icons.paint(painter, disc.adjusted(5, 5, -5, -5), "scale", INK)
        if tile.mark is None:
            return
        font = self._theme.font("small", QFont.Weight.DemiBold)
        font.setItalic(tile.guessed)
        room = box.width() - MARK - 2 * GRID
        if tile.sure:
            room -= QFontMetricsF(font).horizontalAdvance(tile.sure) + GRID
        rows = 1 if QFontMetricsF(font).horizontalAdvance(tile.short) <= room else 2
        high = FOOT if rows == 1 else TWO_ROWS
        foot = QRectF(box.left(), box.bottom() - high, box.width(), high)
        clip = QPainterPath()
        clip.addRoundedRect(box, GRID, GRID)
        painter.setClipPath(clip)
        painter.fillRect(foot, PAPER)
        painter.setClipping(False)
        place = QRectF(foot.left() + GRID / 2, foot.center().y() - MARK / 2, MARK, MARK)
        paint_mark(painter, place, tile.mark)
        painter.setPen(INK)
        painter.setFont(font)
        words, left = foot.adjusted(MARK + GRID, 0, -GRID, 0), Qt.AlignmentFlag.AlignVCenter
        if tile.other is not None:
            painter.drawText(words, left, "→")
            paint_mark(painter, place.translated(MARK + 3 * GRID, 0), tile.other)
        painter.drawText(words, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, tile.sure)
        words.setWidth(room)
        _paint_name(painter, words, tile.short, rows)

    def _paint_frame(self, painter: QPainter, box: QRectF, state: QStyle.StateFlag) -> None:
        chosen = bool(state & QStyle.StateFlag.State_Selected)
        focused = bool(state & QStyle.StateFlag.State_HasFocus)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if chosen:
            painter.setPen(QPen(self._theme.colour("accent"), 4.0))
            painter.drawRoundedRect(box.adjusted(1, 1, -1, -1), GRID, GRID)
        elif focused:
            painter.setPen(QPen(self._theme.colour("accent"), 2.0, Qt.PenStyle.DashLine))
            painter.drawRoundedRect(box, GRID, GRID)


def _paint_name(painter: QPainter, box: QRectF, name: str, rows: int) -> None:
    """Write a name in one row, or in two: its last word below."""
    parts = [name] if rows == 1 else [part for part in name.rpartition(" ") if part.strip()]
    high = min(box.height() / len(parts), QFontMetricsF(painter.font()).height() + 2)
    top = box.center().y() - len(parts) * high / 2
    for number, part in enumerate(parts):
        row = QRectF(box.left(), top + number * high, box.width(), high)
        painter.drawText(row, Qt.AlignmentFlag.AlignVCenter, fitted(painter, part, row.width()))


class FruitGrid(QListView):
    """Fruit in a grid; one or several can be chosen.

    Attributes:
        chosen_changed: other fruit are chosen, or another is the current one.
    """

    chosen_changed = Signal()

    def __init__(self, model: FruitModel, tiles: TileSource, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._model = model
        self._delegate = TileDelegate(theme, tiles, USUAL, self)
        self._wanted_side = USUAL
        self.setModel(model)
        self.setItemDelegate(self._delegate)
        self.setViewMode(QListView.ViewMode.IconMode)
        reach(self)
        self.setMovement(QListView.Movement.Static)
        self.setResizeMode(QListView.ResizeMode.Adjust)
        self.setUniformItemSizes(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
        self.setMouseTracking(True)
        self.viewport().setAttribute(Qt.WidgetAttribute.WA_Hover)
        self.verticalScrollBar().setSingleStep(48)
        self.selectionModel().selectionChanged.connect(self.chosen_changed)
        self.selectionModel().currentChanged.connect(self.chosen_changed)
        model.came.connect(self.viewport().update)
        theme.changed.connect(self.viewport().update)

    @property
    def side(self) -> int:
        """Pixels: of a tile."""
        return self._delegate.side

    def resize_tiles(self, side: int) -> None:
        """Show larger or smaller pictures."""
        self._wanted_side = min(max(side, SMALLEST), LARGEST)
        self._fit()
        if self.currentIndex().isValid():
            self.scrollTo(self.currentIndex())

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Fill the room."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Make tiles as large as fill their rows, near to what is wanted."""
        room = self.width() - self.verticalScrollBar().sizeHint().width() - GRID // 2
        columns = max(round(room / (self._wanted_side + GRID)), 1)
        side = max(room // columns - GRID, SMALLEST // 2)
        if side != self._delegate.side:
            self._delegate.side = side
            self._delegate.sizeHintChanged.emit(self._model.index(0))
            self.scheduleDelayedItemsLayout()

    def show_depth(self, shown: bool) -> None:
        """Show the depth of all fruit, or their colour."""
        self._delegate.depth_of_all = shown
        self.viewport().update()

    def chosen(self) -> list[int]:
        """Return the keys of the fruit that are chosen, in their order; the current one where none is."""
        rows = sorted(index.row() for index in self.selectionModel().selectedIndexes())
        keys = self._model.keys
        return [keys[row] for row in rows if row < len(keys)]

    def current(self) -> int | None:
        """Return the key of the fruit that the keyboard is on."""
        row = self.currentIndex().row()
        return self._model.keys[row] if 0 <= row < len(self._model.keys) else None

    def show_keys(self, keys: Sequence[int]) -> None:
        """Show other fruit; where the chosen ones left, the next in their place is chosen."""
        with QSignalBlocker(self):  # one word at the end is enough
            rows = [index.row() for index in self.selectionModel().selectedIndexes()]
            before = QPersistentModelIndex(self.currentIndex())
            row = min(rows) if rows else max(self.currentIndex().row(), 0)
            self._model.show_keys(keys)
            if keys and not (self.chosen() and before.isValid()):
                self.choose_row(min(row, self._model.rowCount() - 1))
        self.chosen_changed.emit()
        self.viewport().update()

    def choose_row(self, row: int) -> None:
        """Choose one fruit by its row."""
        index = self._model.index(row)
        self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.ClearAndSelect)
        self.scrollTo(index)
