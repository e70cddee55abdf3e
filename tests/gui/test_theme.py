from __future__ import annotations

import pytest
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QComboBox, QLineEdit, QPlainTextEdit, QPushButton, QSpinBox, QToolButton, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import THEMES, Colours


def _luminance(colour: str) -> float:
    parts = [part / 255.0 for part in QColor(colour).getRgb()[:3]]
    linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours (WCAG 2.1, 1 to 21)."""
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("colours", THEMES.values(), ids=THEMES.keys())
@pytest.mark.parametrize("ground", ["ground", "surface", "raised"])
@pytest.mark.parametrize("ink", ["text", "text_dim", "accent", "good", "warn", "bad"])
def test_whatever_is_read_stands_out_from_what_it_lies_on(colours: Colours, ground: str, ink: str) -> None:
    assert contrast(getattr(colours, ground), getattr(colours, ink)) >= 4.5


@pytest.mark.parametrize("colours", THEMES.values(), ids=THEMES.keys())
def test_the_main_button_can_be_read(colours: Colours) -> None:
    assert contrast(colours.accent, colours.on_accent) >= 4.5


@pytest.mark.parametrize("colours", THEMES.values(), ids=THEMES.keys())
@pytest.mark.parametrize("ground", ["ground", "surface", "raised"])
def test_what_can_be_pressed_or_typed_into_has_an_edge_that_is_seen(colours: Colours, ground: str) -> None:
    assert contrast(getattr(colours, ground), colours.edge) >= 3.0


@pytest.mark.parametrize("make", [QPushButton, QToolButton, QComboBox, QLineEdit, QSpinBox, QPlainTextEdit])
def test_controls_are_drawn_with_that_edge(qtbot: QtBot, theme: Theme, make: type[QWidget]) -> None:
    control = make()
    qtbot.addWidget(control)
    control.setFixedSize(200, 60)
    control.ensurePolished()
    picture = control.grab().toImage()
    assert picture.pixelColor(picture.width() // 2, 0).name() == theme.colour("edge").name()
