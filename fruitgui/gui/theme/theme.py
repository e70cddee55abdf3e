"""Puts a theme on the application, and tells whoever paints by hand what it is."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QColor, QFont, QFontDatabase, QPalette
from PySide6.QtWidgets import QApplication

from fruitgui.gui.theme.sheet import style_sheet
from fruitgui.gui.theme.tokens import THEMES, Colours, TypeScale
from fruitgui.resources import folder

FAMILY = "Inter"


class Theme(QObject):
    """The look in force. One is made at the start and handed to whoever paints by hand.

    Attributes:
        changed: another theme was put on.
    """

    changed = Signal()

    def __init__(self, name: str = "dark", parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.name = name

    @property
    def colours(self) -> Colours:
        """The colours in force."""
        return THEMES[self.name]

    @property
    def scale(self) -> TypeScale:
        """The font sizes in force."""
        return TypeScale()

    def colour(self, name: str) -> QColor:
        """Return a colour by the name of its token."""
        return QColor(str(getattr(self.colours, name)))

    def font(self, size: str = "body", weight: QFont.Weight = QFont.Weight.Normal) -> QFont:
        """Return the font of a size's name; its figures all have one width."""
        font = _tabular(QFont(FAMILY))
        font.setPixelSize(int(getattr(self.scale, size)))
        font.setWeight(weight)
        return font

    def put_on(self, application: QApplication, name: str) -> None:
        """Dress the application."""
        self.name = name
        application.setStyle("Fusion")
        application.setPalette(_palette(self.colours))
        application.setFont(self.font())
        application.setStyleSheet(style_sheet(self.name, self.colours, self.scale))
        self.changed.emit()


def load_fonts() -> None:
    """Make the program's own type known to Qt."""
    for path in sorted(folder("fonts").glob("*.otf")):
        QFontDatabase.addApplicationFont(str(path))


def _tabular(font: QFont) -> QFont:
    """Let every figure have the same width, so that counting numbers do not dance."""
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


def _palette(colours: Colours) -> QPalette:
    role = QPalette.ColorRole
    palette = QPalette()
    for target, colour in (
        (role.Window, colours.ground), (role.WindowText, colours.text), (role.Base, colours.surface),
        (role.AlternateBase, colours.raised), (role.Text, colours.text), (role.Button, colours.raised),
        (role.ButtonText, colours.text), (role.Highlight, colours.accent), (role.HighlightedText, colours.on_accent),
        (role.PlaceholderText, colours.text_dim), (role.ToolTipBase, colours.raised), (role.ToolTipText, colours.text),
        (role.Mid, colours.line), (role.Link, colours.accent),
    ):  # fmt: skip
        palette.setColor(target, QColor(colour))
    palette.setColor(QPalette.ColorGroup.Disabled, role.Text, QColor(colours.text_dim))
    return palette
