from __future__ import annotations

import pytest
from PySide6.QtWidgets import QComboBox, QLineEdit, QPlainTextEdit, QPushButton, QSpinBox, QToolButton, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.rail import COLOURS
from fruitgui.gui.theme.contrast import contrast
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import THEMES, Colours
from fruitgui.station.workflow import State


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


def test_contrast_is_as_it_is_defined() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#ffffff", "#ffffff") == pytest.approx(1.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("colours", THEMES.values(), ids=THEMES.keys())
@pytest.mark.parametrize("kept_by", ["ground", "surface", "raised"])
def test_the_ring_of_the_keyboard_is_seen_where_a_frame_was_or_none(colours: Colours, kept_by: str) -> None:
    assert contrast(colours.text, getattr(colours, kept_by)) >= 3.0


@pytest.mark.parametrize("colours", THEMES.values(), ids=THEMES.keys())
@pytest.mark.parametrize("state", list(State))
def test_the_state_of_a_step_has_a_mark_that_is_seen(colours: Colours, state: State) -> None:
    assert contrast(getattr(colours, COLOURS[state]), colours.surface) >= 3.0


@pytest.mark.parametrize("make", [QPushButton, QToolButton, QComboBox, QLineEdit, QSpinBox, QPlainTextEdit])
def test_controls_are_drawn_with_that_edge(qtbot: QtBot, theme: Theme, make: type[QWidget]) -> None:
    control = make()
    qtbot.addWidget(control)
    control.setFixedSize(200, 60)
    control.ensurePolished()
    picture = control.grab().toImage()
    assert picture.pixelColor(picture.width() // 2, 0).name() == theme.colour("edge").name()
