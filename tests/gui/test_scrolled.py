"""Columns that scroll: no word is clipped, however narrow they are."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QPointingDevice
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QListWidget, QPushButton, QScroller, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.widgets.reach import reach
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


def _touch(area: QWidget, device: QPointingDevice, *points: QPoint) -> None:
    """Put a finger down at the first point, move it over the others, and lift it at the last."""
    QTest.touchEvent(area, device).press(0, points[0], area).commit()
    for point in points[1:]:
        QTest.qWait(10)  # the speed of a finger is part of what it says
        QTest.touchEvent(area, device).move(0, point, area).commit()
    QTest.touchEvent(area, device).release(0, points[-1], area).commit()


@pytest.mark.usefixtures("theme")
def test_a_finger_presses_what_it_taps_and_scrolls_where_it_moves(qtbot: QtBot) -> None:
    pressed: list[int] = []
    inner = QWidget()
    column = QVBoxLayout(inner)
    for number in range(40):
        button = QPushButton(f"Button {number}")
        button.clicked.connect(lambda _checked=False, number=number: pressed.append(number))
        column.addWidget(button)
    area = Scrolled(inner)
    qtbot.addWidget(area)
    area.resize(300, 400)
    area.show()
    button = inner.findChildren(QPushButton)[2]
    finger, bar = QTest.createTouchDevice(), area.verticalScrollBar()
    middle = button.rect().center()
    _touch(button, finger, middle)
    qtbot.waitUntil(lambda: pressed == [2])
    assert bar.value() == 0
    _touch(button, finger, *(middle - QPoint(0, 12 * step) for step in range(12)))
    qtbot.waitUntil(lambda: bar.value() > 40)
    assert pressed == [2], "a finger that moves presses nothing"


@pytest.mark.usefixtures("theme")
def test_a_finger_chooses_the_row_that_it_taps_and_none_where_it_scrolls(qtbot: QtBot) -> None:
    rows = QListWidget()
    rows.addItems([f"Lot {number}" for number in range(60)])
    rows.setVerticalScrollMode(QListWidget.ScrollMode.ScrollPerPixel)
    reach(rows)
    qtbot.addWidget(rows)
    rows.resize(300, 400)
    rows.show()
    rows.setCurrentRow(1)
    chosen: list[int] = []
    rows.currentRowChanged.connect(chosen.append)
    finger, bar, area = QTest.createTouchDevice(), rows.verticalScrollBar(), rows.viewport()
    low = rows.visualItemRect(rows.item(6)).center()
    _touch(area, finger, *(low - QPoint(0, 12 * step) for step in range(12)))
    qtbot.waitUntil(lambda: bar.value() > 40)
    qtbot.waitUntil(lambda: QScroller.scroller(area).state() == QScroller.State.Inactive)
    assert chosen == []
    assert rows.selectedItems() == [rows.item(1)]
    wanted = rows.itemAt(low)
    _touch(area, finger, low)
    qtbot.waitUntil(lambda: rows.selectedItems() == [wanted])
    assert chosen == [rows.row(wanted)]
    qtbot.mousePress(area, Qt.MouseButton.LeftButton, pos=rows.visualItemRect(wanted).center() - QPoint(0, 60))
    assert len(chosen) == 2, "a mouse chooses as it is pressed"
