"""The manual as it is read: set in the program's own type, in the theme's colours, with its pictures in good size."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from PySide6.QtCore import QPoint, Qt, QUrl
from PySide6.QtGui import (
    QBrush,
    QFont,
    QImage,
    QResizeEvent,
    QTextBlock,
    QTextBlockFormat,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
    QTextFrame,
    QTextFrameFormat,
    QTextLength,
    QTextTable,
)
from PySide6.QtWidgets import QTextBrowser, QWidget

from fruitgui.gui.theme.theme import FAMILY, Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.reach import scrolled_by_finger

WIDEST_PICTURE = 760
"""Pixels."""

WIDEST_PX = 900
"""Of the text: a longer line is lost on the way back to the next one."""

LINE_PERCENT, CELL_LINE_PERCENT = 130.0, 115.0
"""Height of a line; in cells of tables it is less."""

_SIZES = {1: "page", 2: "title", 3: "body"}
_SPACE_ABOVE = {1: 0, 2: 4 * GRID, 3: 2 * GRID}
_KEY = QTextFormat.Property.UserProperty.value + 1
"""Marks what Markdown writes in backticks: keys and codes."""


class ManualView(QTextBrowser):
    """Shows a page written in Markdown.

    Args:
        theme: whose type and colours it has; it follows when that changes.
    """

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._page: QTextDocument | None = None
        self.setProperty("role", "manual")
        self.setOpenExternalLinks(True)
        self.setAccessibleName(self.tr("Manual"))
        scrolled_by_finger(self)
        theme.changed.connect(self._set_anew)

    def show_page(self, page: Path) -> None:
        """Read a page; its pictures are found as seen from its folder."""
        before, self._page = self._page, QTextDocument(self)
        document = self._page  # always a new one: Qt 6.11 crashes where it reads a page over another that was shown
        document.setBaseUrl(QUrl.fromLocalFile(f"{page.parent}/"))
        document.setMarkdown(page.read_text(encoding="utf-8"), QTextDocument.MarkdownFeature.MarkdownDialectGitHub)
        self.setDocument(document)
        if before is not None:
            before.deleteLater()
        self._set()
        self._bring_to_top(None)

    def show_chapter(self, number: int) -> None:
        """Scroll to the chapter (a heading of the second level) that begins with a number."""
        for block in _blocks(self.document()):
            if block.blockFormat().headingLevel() == 2 and block.text().startswith(f"{number}."):
                self._bring_to_top(block)
                return

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Keep lines short and in the middle, and what is being read where it is."""
        read = self._at_top()
        side = max((self.width() - WIDEST_PX) // 2, 0)
        self.setViewportMargins(side, 0, side, 0)
        super().resizeEvent(event)
        self._bring_to_top(read)

    def loadResource(self, kind: int, name: QUrl | str) -> object:  # noqa: N802 - Qt's name
        """Return a picture no wider than the text, smoothly made smaller, or what else is asked for."""
        found = super().loadResource(kind, QUrl(name))
        if kind != QTextDocument.ResourceType.ImageResource.value:
            return found
        image = QImage(self.document().baseUrl().resolved(QUrl(name)).toLocalFile())
        return _fitted(image, self.devicePixelRatioF())

    def _at_top(self) -> QTextBlock | None:
        """Return what is being read; None at the very beginning."""
        return self.cursorForPosition(QPoint(0, 0)).block() if self.verticalScrollBar().value() else None

    def _bring_to_top(self, block: QTextBlock | None) -> None:
        document = self.document()
        document.size()  # lays out all of it, so that there is something to scroll to
        # What has the cursor is what Qt shows first, and what is read aloud.
        self.setTextCursor(QTextCursor(document) if block is None else QTextCursor(block))
        top = 0.0 if block is None else document.documentLayout().blockBoundingRect(block).top()
        self.verticalScrollBar().setValue(int(top))

    def _set_anew(self) -> None:
        read = self._at_top()
        self._set()
        self._bring_to_top(read)

    def _set(self) -> None:
        document = self.document()
        document.setDocumentMargin(3 * GRID)
        document.setDefaultFont(self._theme.font())
        for block in _blocks(document):
            _set_block(block, self._theme)
        for table in _tables(document.rootFrame()):
            _set_table(table, self._theme)


def _fitted(image: QImage, ratio: float) -> QImage:
    width = round(min(image.width(), WIDEST_PICTURE) * ratio)
    if image.isNull() or width == image.width():
        return image
    fitted = image.scaledToWidth(width, Qt.TransformationMode.SmoothTransformation)
    fitted.setDevicePixelRatio(ratio)
    return fitted


def _blocks(document: QTextDocument) -> Iterator[QTextBlock]:
    block = document.begin()
    while block.isValid():
        yield block
        block = block.next()


def _tables(frame: QTextFrame) -> Iterator[QTextTable]:
    for child in frame.childFrames():
        if isinstance(child, QTextTable):
            yield child


def _set_block(block: QTextBlock, theme: Theme) -> None:
    """Set spaces and type of a paragraph, an entry of a list, a cell or a heading."""
    level = block.blockFormat().headingLevel()
    cursor = QTextCursor(block)
    pieces = _pieces(block)
    cursor.mergeBlockFormat(_spaces(level, in_list=block.textList() is not None, table=cursor.currentTable()))
    if any(had.isImageFormat() for _, _, had in pieces):
        cursor.mergeBlockFormat(_lines(100.0))  # of a picture's height, more would be a hole below it
    for begin, end, had in pieces:
        cursor.setPosition(begin)
        cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
        cursor.setCharFormat(_type(had, level, theme))


def _pieces(block: QTextBlock) -> list[tuple[int, int, QTextCharFormat]]:
    """Return where each piece of one type begins and ends; setting one may join it with the next."""
    found, at = [], block.begin()
    while not at.atEnd():
        piece = at.fragment()
        found.append((piece.position(), piece.position() + piece.length(), piece.charFormat()))
        at += 1
    return found


def _spaces(level: int, *, in_list: bool, table: QTextTable | None) -> QTextBlockFormat:
    form = _lines(LINE_PERCENT if table is None else CELL_LINE_PERCENT)
    form.setTopMargin(0 if table is not None or in_list else _SPACE_ABOVE.get(level, GRID))
    form.setBottomMargin(0 if table is not None else (GRID / 2 if in_list else GRID))
    return form


def _lines(percent: float) -> QTextBlockFormat:
    form = QTextBlockFormat()
    form.setLineHeight(percent, QTextBlockFormat.LineHeightTypes.ProportionalHeight.value)
    return form


def _type(had: QTextCharFormat, level: int, theme: Theme) -> QTextCharFormat:
    """Return the type of a piece of text: of a heading, of a key, or plain."""
    form = QTextCharFormat(had)
    form.clearProperty(QTextFormat.Property.FontSizeAdjustment)
    form.setProperty(QTextFormat.Property.FontPixelSize, getattr(theme.scale, _SIZES.get(level, "body")))
    form.setForeground(theme.colour("text"))
    if level or had.fontWeight() > QFont.Weight.Medium:
        form.setFontWeight(QFont.Weight.DemiBold)
    if had.fontFixedPitch() or had.hasProperty(_KEY):
        form.setProperty(_KEY, True)
        form.setFontFamilies([FAMILY])
        form.setFontFixedPitch(False)
        form.setFontWeight(QFont.Weight.Medium)
        form.setBackground(theme.colour("ground"))
    return form


def _set_table(table: QTextTable, theme: Theme) -> None:
    form = table.format()
    form.setBorder(1)
    form.setBorderCollapse(True)
    form.setBorderBrush(QBrush(theme.colour("line")))
    form.setBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
    form.setCellPadding(GRID)
    form.setCellSpacing(0)
    form.setTopMargin(GRID / 2)
    form.setBottomMargin(2 * GRID)
    form.setWidth(QTextLength(QTextLength.Type.PercentageLength, 100))
    table.setFormat(form)
