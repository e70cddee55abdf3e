"""The bar at the top: which line and lot, whether all is well, and the way to help and settings."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import QEvent, QPoint, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QIcon, QPainter
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QToolTip, QVBoxLayout, QWidget

from fruitgui.gui.theme import icons
from fruitgui.gui.theme.stamps import drawn_pixmap
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID

PILL_PX, PILL_GAP, TOOL_PX = 20, 4, 22


@dataclass(frozen=True, slots=True)
class Pill:
    """A short word on the health of something.

    Attributes:
        name: of what; stable. icon: its drawing. text: what is shown. health: `good`, `warn`, `bad`, or none.
        tip: the whole sentence.
    """

    name: str
    icon: str
    text: str
    health: str = ""
    tip: str = ""


class TopBar(QWidget):
    """Title, health pills, help, theme, settings.

    Attributes:
        help_wanted, theme_wanted, settings_wanted: a button was pressed.
        words_wanted: the language is another; whoever shows pills says them anew.
    """

    help_wanted = Signal()
    theme_wanted = Signal()
    settings_wanted = Signal()
    words_wanted = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._shown: tuple[Pill, ...] = ()
        self.setProperty("role", "bar")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._title, self._lot = QLabel(self), QLabel(self)
        self._title.setProperty("role", "title")
        self._lot.setProperty("role", "dim")
        self._pills: dict[str, QToolButton] = {}
        self._icons: dict[str, tuple[str, str]] = {}
        self._pill_row = QHBoxLayout()
        self._pill_row.setSpacing(GRID // 2)
        self._tools = {name: QToolButton(self) for name in ("theme", "settings", "help")}
        for name, wanted in zip(self._tools, (self.theme_wanted, self.settings_wanted, self.help_wanted), strict=True):
            self._tools[name].clicked.connect(wanted)
        self._lay_out()
        theme.changed.connect(self._draw)
        self._say_words()
        self._draw()

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.setContentsMargins(3 * GRID, GRID, GRID, GRID)
        row.setSpacing(2 * GRID)
        row.addWidget(self._title)
        row.addWidget(self._lot, 1)
        row.addLayout(self._pill_row)
        for tool in self._tools.values():
            tool.setProperty("role", "quiet")
            tool.setIconSize(QSize(TOOL_PX, TOOL_PX))
            row.addWidget(tool)
        row.setSpacing(GRID)
        line = QFrame(self)
        line.setProperty("role", "hairline")
        line.setFixedHeight(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(row)
        column.addWidget(line)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_place(self, title: str, lot: str) -> None:
        """Show the line's name and the lot that runs."""
        self._title.setText(title)
        self._lot.setText(lot)

    def show_pills(self, pills: tuple[Pill, ...]) -> None:
        """Show these pills, in this order."""
        if pills == self._shown:
            return
        if [pill.name for pill in pills] != [pill.name for pill in self._shown]:
            self._make_pills(pills)
        self._shown = pills
        self._draw_pills()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self.words_wanted.emit()
        super().changeEvent(event)

    def _make_pills(self, pills: tuple[Pill, ...]) -> None:
        for button in self._pills.values():
            self._pill_row.removeWidget(button)
            button.hide()
            button.deleteLater()
        self._pills = {pill.name: QToolButton(self) for pill in pills}
        self._icons = {}
        for button in self._pills.values():
            button.setProperty("role", "quiet")
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            button.clicked.connect(partial(self._tell, button))
            self._pill_row.addWidget(button)

    def _tell(self, button: QToolButton) -> None:
        """Say the whole sentence at once: a finger and a keyboard have no pointer to rest on it."""
        below = button.mapToGlobal(QPoint(0, button.height()))
        QToolTip.showText(below, button.toolTip(), button)

    def _draw_pills(self) -> None:
        for pill in self._shown:
            button, drawn = self._pills[pill.name], (pill.icon, pill.health)
            button.setText(pill.text)
            button.setToolTip(pill.tip or pill.text)
            button.setAccessibleName(pill.tip or pill.text)
            if self._icons.get(pill.name) != drawn:  # drawing one takes ten times as long as all else here
                self._icons[pill.name] = drawn
                self._draw_pill(button, pill)

    def _draw_pill(self, button: QToolButton, pill: Pill) -> None:
        """Draw what it is about, and where that is not well the sign of that beside it: not by colour alone."""
        colour = self._theme.colour(pill.health or "text_dim")
        signs = (pill.icon, pill.health) if pill.health in ("warn", "bad") else (pill.icon,)
        ratio, width = self.devicePixelRatioF(), PILL_PX * len(signs) + PILL_GAP * (len(signs) - 1)

        def paint(painter: QPainter) -> None:
            for number, name in enumerate(signs):
                place = QRectF(number * (PILL_PX + PILL_GAP), 0, PILL_PX, PILL_PX)
                icons.paint(painter, place, name, colour)

        button.setIcon(QIcon(drawn_pixmap(width, PILL_PX, ratio, paint)))
        button.setIconSize(QSize(width, PILL_PX))

    def _draw(self) -> None:
        self._icons = {}
        self._draw_pills()
        for name, tool in self._tools.items():
            tool.setIcon(icons.icon(name, self._theme.colour("text_dim"), size_px=TOOL_PX))

    def _say_words(self) -> None:
        words = {
            "theme": self.tr("Light or dark (Ctrl+T)"),
            "settings": self.tr("Settings (Ctrl+,)"),
            "help": self.tr("Help (F1)"),
        }
        for name, text in words.items():
            self._tools[name].setToolTip(text)
            self._tools[name].setAccessibleName(text)
