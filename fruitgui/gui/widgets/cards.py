"""Cards, titles and empty places: the plain furniture of every screen."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QVBoxLayout, QWidget

from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID

EMPTY_ICON_PX = 56


class Card(QFrame):
    """A framed surface with a title; content goes into `body`."""

    def __init__(self, title: str = "", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "card")
        self._title = label(title, "strong")
        self._title.setVisible(bool(title))
        self.body = QVBoxLayout()
        self.body.setSpacing(GRID)
        column = QVBoxLayout(self)
        column.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        column.setSpacing(GRID)
        column.addWidget(self._title)
        column.addLayout(self.body, 1)

    def set_title(self, title: str) -> None:
        """Set the title; an empty one takes no room."""
        self._title.setText(title)
        self._title.setVisible(bool(title))


class EmptyPlace(QWidget):
    """What stands where nothing is yet: what will appear here, and how."""

    def __init__(self, theme: Theme, icon: str, what: str = "", how: str = "", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._name = icon
        self._icon, self._what, self._how = QLabel(self), label(what, "title"), label(how, "dim")
        for one in (self._icon, self._what, self._how):
            one.setAlignment(Qt.AlignmentFlag.AlignCenter)
            one.setWordWrap(one is not self._icon)
        column = QVBoxLayout(self)
        column.setContentsMargins(4 * GRID, 4 * GRID, 4 * GRID, 4 * GRID)
        column.setSpacing(2 * GRID)
        column.addStretch()
        for one in (self._icon, self._what, self._how):
            column.addWidget(one)
        column.addStretch()
        theme.changed.connect(self._draw)
        self._draw()

    def show_words(self, what: str, how: str) -> None:
        """Set what will appear here, and how it gets here."""
        self._what.setText(what)
        self._how.setText(how)

    def _draw(self) -> None:
        colour = self._theme.colour("text_dim")
        self._icon.setPixmap(icons.pixmap(self._name, colour, EMPTY_ICON_PX, self.devicePixelRatioF()))


def label(text: str = "", role: str = "") -> QLabel:
    """Return a label in one of the theme's roles."""
    made = QLabel(text)
    made.setTextFormat(Qt.TextFormat.PlainText)
    if role:
        made.setProperty("role", role)
    return made


def set_health(widget: QWidget, health: str) -> None:
    """Colour a label by health: `good`, `warn`, `bad`, or nothing."""
    if widget.property("health") != health:
        widget.setProperty("health", health)
        widget.style().unpolish(widget)
        widget.style().polish(widget)


def set_role(widget: QWidget, role: str) -> None:
    """Dress a widget in one of the theme's roles, such as `main` for the button that one is to press."""
    if widget.property("role") != role:
        widget.setProperty("role", role)
        widget.style().unpolish(widget)
        widget.style().polish(widget)
