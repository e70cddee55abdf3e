"""Columns that scroll: no word is clipped, however narrow they are."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.widgets.scrolled import Scrolled

WORDS = "Check its cable and its power supply; it is opened again by itself when it returns. " * 4


@pytest.mark.parametrize("width", [120, 240, 600])
def test_it_is_as_high_as_its_words_need(qtbot: QtBot, width: int) -> None:
    inner = QWidget()
    column = QVBoxLayout(inner)
    words = [QLabel(WORDS), QLabel("short")]
    for one in words:
        one.setWordWrap(True)
        column.addWidget(one)
    scrolled = Scrolled(inner)
    qtbot.addWidget(scrolled)
    scrolled.resize(width, 100)
    scrolled.show()
    qtbot.waitUntil(lambda: words[0].height() >= words[0].heightForWidth(words[0].width()))
    assert inner.width() == scrolled.viewport().width()
    words[1].setText(WORDS)
    qtbot.waitUntil(lambda: all(one.height() >= one.heightForWidth(one.width()) for one in words))
