"""The one style sheet of the window, made from the tokens."""

from __future__ import annotations

from string import Template

from fruitgui.gui.theme.tokens import RADIUS, TOUCH, Colours, TypeScale
from fruitgui.resources import folder

_SHEET = Template(
    """
* { outline: 0; }
QWidget { color: $text; font-size: ${body}px; }
QMainWindow, QDialog, QWidget[role="ground"] { background: $ground; }
QWidget[role="bar"] { background: $surface; border: 0 solid $line; }
QFrame[role="card"] { background: $surface; border: 1px solid $line; border-radius: ${radius}px; }
QFrame[role="raised"] { background: $raised; border: 0; border-radius: ${radius}px; }
QFrame[role="picture"] { background: $picture; border: 0; border-radius: ${radius}px; }
QFrame[role="hairline"] { background: $line; border: 0; }
QLabel { background: transparent; }
QLabel[role="page"] { font-size: ${page}px; font-weight: 600; }
QLabel[role="title"] { font-size: ${title}px; font-weight: 600; }
QLabel[role="strong"] { font-weight: 600; }
QLabel[role="dim"] { color: $text_dim; }
QLabel[role="small"] { color: $text_dim; font-size: ${small}px; }
QLabel[role="figure"] { font-size: ${figure}px; font-weight: 600; }
QLabel[health="good"] { color: $good; }
QLabel[health="warn"] { color: $warn; }
QLabel[health="bad"] { color: $bad; }

QPushButton, QToolButton, QComboBox {
    background: $raised; border: 1px solid $edge; border-radius: 8px;
    min-height: ${inner}px; padding: 0 16px;
}
QToolButton { padding: 0 10px; }
QToolButton::menu-indicator { image: none; width: 0; }
QPushButton:hover, QToolButton:hover, QComboBox:hover { border-color: $text_dim; }
QPushButton:pressed, QToolButton:pressed { background: $line; }
QPushButton:checked, QToolButton:checked {
    background: $raised; color: $accent; border-color: $accent; border-bottom: 3px solid $accent;
    min-height: ${inner_focus}px;
}
QLineEdit:focus, QAbstractSpinBox:focus, QTextEdit:focus, QPlainTextEdit:focus { border: 2px solid $text; }
QLineEdit:focus, QAbstractSpinBox:focus { min-height: ${inner_focus}px; padding: 0 9px; }
QPushButton:focus, QToolButton:focus, QComboBox:focus {
    border: 2px solid $text; min-height: ${inner_focus}px; padding: 0 15px;
}
QToolButton:focus { padding: 0 9px; }
QPushButton:checked:focus, QToolButton:checked:focus { border-bottom: 3px solid $text; min-height: ${inner_both}px; }
QPushButton:disabled, QToolButton:disabled { color: $text_dim; background: $ground; border-color: $line; }
QPushButton[role="main"] { background: $accent; color: $on_accent; border-color: $accent; font-weight: 600; }
QPushButton[role="main"]:hover { border-color: $text; }
QPushButton[role="main"]:focus {
    border: 5px double $text; background-clip: padding; min-height: ${inner_main}px; padding: 0 12px;
}
QPushButton[role="main"]:disabled { background: $raised; color: $text_dim; border-color: $line; }
QPushButton[role="quiet"], QToolButton[role="quiet"] { background: transparent; border-color: transparent; }
QPushButton[role="quiet"]:hover, QToolButton[role="quiet"]:hover { background: $raised; }
QPushButton[role="quiet"]:focus, QToolButton[role="quiet"]:focus { border: 2px solid $text; }
QPushButton[role="danger"] { color: $bad; }

QLineEdit, QAbstractSpinBox, QTextEdit, QPlainTextEdit {
    background: $raised; border: 1px solid $edge; border-radius: 8px; min-height: ${inner}px; padding: 0 10px;
    selection-background-color: $accent; selection-color: $on_accent;
}
QAbstractSpinBox::up-button { subcontrol-origin: border; subcontrol-position: top right; width: 0; border: 0; }
QAbstractSpinBox::down-button { subcontrol-origin: border; subcontrol-position: bottom right; width: 0; border: 0; }
QAbstractSpinBox QLineEdit { background: transparent; border: 0; min-height: 0; padding: 0 10px; }
QTextEdit, QPlainTextEdit { padding: 8px; }
QTextBrowser[role="manual"] { background: $surface; border-color: $line; border-radius: ${radius}px; padding: 0; }
QTextBrowser[role="manual"]:focus { border-color: $text; }
QComboBox::drop-down { border: 0; width: 32px; }
QComboBox::down-arrow { image: url($controls/down-$name.svg); width: 18px; height: 18px; }
QComboBox QAbstractItemView { background: $surface; border: 1px solid $line; selection-background-color: $accent;
    selection-color: $on_accent; }
QCheckBox, QRadioButton { spacing: 10px; min-height: ${inner}px; background: transparent; }
QCheckBox::indicator, QRadioButton::indicator { width: 22px; height: 22px; border: 2px solid $text_dim;
    background: $raised; }
QCheckBox::indicator { border-radius: 5px; }
QRadioButton::indicator { border-radius: 13px; }
QCheckBox::indicator:checked, QRadioButton::indicator:checked { background: $accent; border-color: $accent; }
QCheckBox::indicator:checked { image: url($controls/tick-$name.svg); }
QRadioButton::indicator:checked { image: url($controls/dot-$name.svg); }
QCheckBox:focus, QRadioButton:focus { border: 2px solid $text; border-radius: 8px; }
QSlider::groove:horizontal { height: 6px; background: $line; border-radius: 3px; }
QSlider::sub-page:horizontal { background: $accent; border-radius: 3px; }
QSlider::handle:horizontal {
    width: 40px; height: 40px; margin: -17px 0;
    background: qradialgradient(cx: 0.5, cy: 0.5, radius: 0.5, fx: 0.5, fy: 0.5,
        stop: 0 $accent, stop: 0.68 $accent, stop: 0.72 transparent);
}
QSlider:focus { border: 2px solid $text; border-radius: 8px; }
QSlider { min-height: ${touch}px; background: transparent; }
QProgressBar { background: $line; border: 0; border-radius: 4px; max-height: 8px; min-height: 8px; }
QProgressBar::chunk { background: $accent; border-radius: 4px; }

QListView, QTreeView, QTableView, QScrollArea { background: transparent; border: 0;
    alternate-background-color: $raised; }
QAbstractScrollArea > QWidget > QWidget[role="scrolled"] { background: transparent; }
QTableView, QTreeView, QListView { gridline-color: $line; selection-background-color: $raised;
    selection-color: $text; }
QHeaderView { background: transparent; border: 0; }
QHeaderView::section { background: transparent; color: $text_dim; border: 0; border-bottom: 1px solid $line;
    padding: 8px; font-size: ${small}px; }
QTableView::item, QTreeView::item, QListView::item { padding: 6px; border: 0; }
QListView::item, QComboBox QAbstractItemView::item { min-height: 30px; }
QListWidget::item:selected { background: $raised; border: 1px solid $accent; border-radius: ${radius}px; }
QTableView::item:focus, QListView::item:focus, QTreeView::item:focus { border: 2px solid $accent; }
QScrollBar:vertical { background: transparent; width: 14px; }
QScrollBar:horizontal { background: transparent; height: 14px; }
QScrollBar::handle { background: $line; border-radius: 5px; min-height: 40px; min-width: 40px; margin: 2px; }
QScrollBar::handle:hover { background: $text_dim; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QTabBar { background: transparent; }
QTabBar::tab { background: transparent; border: 0; border-bottom: 3px solid transparent; padding: 10px 16px;
    min-height: 24px; color: $text_dim; }
QTabBar::tab:selected { color: $text; border-bottom-color: $accent; }
QTabBar::tab:focus { border: 2px solid $text; }
QTabWidget::pane { border: 0; }
QToolTip { background: $raised; color: $text; border: 1px solid $line; padding: 6px; }
QMenu { background: $surface; border: 1px solid $line; padding: 6px; }
QMenu::item { padding: 12px 24px; border-radius: 6px; }
QMenu::item:selected { background: $raised; }
QSplitter::handle { background: transparent; }

QAbstractButton[role="step"] { background: transparent; border: 0; }
"""
)


def style_sheet(name: str, colours: Colours, scale: TypeScale) -> str:
    """Return the style sheet of a theme; its name is part of the names of the drawings that controls carry."""
    words = {name: getattr(colours, name) for name in Colours.__dataclass_fields__}
    words |= {name: getattr(scale, name) for name in TypeScale.__dataclass_fields__}
    controls = (folder("icons") / "controls").as_posix()
    return _SHEET.substitute(words, name=name, controls=controls, radius=RADIUS, touch=TOUCH, inner=TOUCH - 4,
                             inner_focus=TOUCH - 6, inner_main=TOUCH - 12,
                             inner_both=TOUCH - 7)  # fmt: skip
