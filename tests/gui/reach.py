"""What a hand, an eye and a keyboard reach in a window: sizes of what is pressed, words cut off, the focus seen."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from PySide6.QtCore import QCoreApplication, QPoint, QRect, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractScrollArea,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QScrollBar,
    QSlider,
    QStyle,
    QStyleOptionComboBox,
    QStyleOptionSlider,
    QToolButton,
    QWidget,
)
from shiboken6 import isValid

from fruitgui.frame import F64
from fruitgui.gui.steps.connect.tile import SensorTile
from fruitgui.gui.theme.contrast import SHAPES

LEAST_PX = 40
"""What a gloved finger hits."""

PRESSED = (QAbstractButton, QComboBox, QLineEdit, QAbstractSpinBox, QSlider)
WORKED = (*PRESSED, QAbstractItemView)


def shown(top: QWidget) -> Iterator[QWidget]:
    """Give what is in view of a window, without what Qt puts into its own widgets.

    A screen is drawn anew while one walks over it: what went meanwhile is left out.
    """
    for widget in top.findChildren(QWidget):
        if not isValid(widget):
            continue
        inside = isinstance(widget, QLineEdit) and isinstance(widget.parentWidget(), (QAbstractSpinBox, QComboBox))
        of_qt = widget.objectName().startswith("qt_") or isinstance(widget, (QScrollBar, QHeaderView))
        if widget.isVisibleTo(top) and not inside and not of_qt:
            yield widget


def named(widget: QWidget) -> str:
    """Return which widget it is, for whoever reads of a failure."""
    text = widget.text() if isinstance(widget, (QAbstractButton, QLabel, QLineEdit)) else ""
    return f"{type(widget).__name__} {text or widget.accessibleName()!r}"


def too_small(top: QWidget) -> list[str]:
    """Return what is pressed and smaller than a gloved finger, or takes no press at one of its edges."""
    found = []
    for widget in shown(top):
        if not isinstance(widget, PRESSED):
            continue
        if min(widget.width(), widget.height()) < LEAST_PX:
            found.append(f"{named(widget)} is {widget.width()} x {widget.height()}")
        elif isinstance(widget, QAbstractButton):
            middle = widget.width() // 2 if not widget.isCheckable() else LEAST_PX // 2
            edges = (QPoint(middle, 2), QPoint(middle, widget.height() - 3))
            if not all(widget.hitButton(one) for one in edges):
                found.append(f"{named(widget)} takes no press at its edge")
    return found


def rows_too_small(top: QWidget) -> list[str]:
    """Return what unfolds, is listed or is dragged in pieces smaller than a gloved finger."""
    found = []
    for widget in shown(top):
        rows: list[int] = []
        if isinstance(widget, QComboBox) and widget.count():
            rows = [widget.view().sizeHintForRow(0)]
        elif isinstance(widget, QAbstractItemView) and widget.model().rowCount():
            rows = [widget.visualRect(widget.model().index(0, 0)).height()]
        elif isinstance(widget, QSlider):
            option = QStyleOptionSlider()
            widget.initStyleOption(option)
            control, part = QStyle.ComplexControl.CC_Slider, QStyle.SubControl.SC_SliderHandle
            handle = widget.style().subControlRect(control, option, part, widget)
            rows = [handle.width(), handle.height()]
        if isinstance(widget, QPushButton | QToolButton) and widget.menu() is not None:
            menu = widget.menu()
            rows = [menu.actionGeometry(one).height() for one in menu.actions() if not one.isSeparator()]
        found += [f"{named(widget)}: {row} pixels" for row in rows if row < LEAST_PX]
    return found


def cut_off(top: QWidget) -> list[str]:
    """Return the words that have less room than they take."""
    return [
        f"{named(widget)} has {widget.width()} x {widget.height()} of {needed[0]} x {needed[1]}"
        for widget in shown(top)
        if (needed := _needed(widget)) is not None
        and (needed[0] > widget.width() + 1 or needed[1] > widget.height() + 1)
    ]


def _needed(widget: QWidget) -> tuple[int, int] | None:
    """Return the room that a widget's words take at least; None where it has none, or draws them itself."""
    if isinstance(widget, QLabel) and widget.text() and widget.pixmap().isNull():
        if widget.wordWrap():
            return 0, widget.heightForWidth(widget.width())
        return widget.sizeHint().toTuple()
    if isinstance(widget, QAbstractButton) and widget.text() and not isinstance(widget, SensorTile):
        return widget.sizeHint().toTuple()
    if isinstance(widget, QComboBox):
        option = QStyleOptionComboBox()
        widget.initStyleOption(option)
        control, part = QStyle.ComplexControl.CC_ComboBox, QStyle.SubControl.SC_ComboBoxEditField
        room = widget.style().subControlRect(control, option, part, widget).width()
        words = widget.fontMetrics().horizontalAdvance(widget.currentText())
        return widget.width() + max(words - room, 0), 0
    return None


def out_of_keyboard(top: QWidget) -> list[str]:
    """Return what can be worked with and is not come to by the Tab key; what steps a number is worked by that."""
    return [
        named(widget)
        for widget in shown(top)
        if isinstance(widget, WORKED) and widget.isEnabled()
        and not widget.focusPolicy() & Qt.FocusPolicy.TabFocus and widget.focusProxy() is None
        and not _steps_a_number(widget)
    ]  # fmt: skip


def _steps_a_number(widget: QWidget) -> bool:
    around = widget.parentWidget()
    return around is not None and around.findChild(QAbstractSpinBox) is not None


def focus_unseen(top: QWidget) -> list[str]:
    """Return what has the keyboard without showing it: fewer pixels than go round it change clearly (WCAG 2.4.13)."""
    found = []
    for widget in shown(top):
        comes = widget.isEnabled() and widget.focusPolicy() & Qt.FocusPolicy.TabFocus and widget.focusProxy() is None
        if not comes or not isinstance(widget, (*WORKED, QAbstractScrollArea)):
            continue
        _scroll_to(widget)
        before = _without_focus(top, widget)
        if not isValid(widget):
            continue
        widget.setFocus(Qt.FocusReason.TabFocusReason)
        QCoreApplication.processEvents()
        if not isValid(widget):
            continue
        after = _light(top, widget)
        if widget.hasFocus() and before.shape == after.shape:
            contrast = (np.maximum(before, after) + 0.05) / (np.minimum(before, after) + 0.05)
            round_it = 2 * (widget.width() + widget.height())
            seen = int((contrast >= SHAPES).sum())
            if seen < 0.8 * round_it:
                found.append(f"{named(widget)}: {seen} pixels of {round_it}")
    return found


def _scroll_to(widget: QWidget) -> None:
    """Bring it into view, as the Tab key does."""
    around = widget.parentWidget()
    while around is not None:
        if isinstance(around, QScrollArea):
            around.ensureWidgetVisible(widget)
        around = around.parentWidget()


def _without_focus(top: QWidget, widget: QWidget) -> F64:
    had = QApplication.focusWidget()
    if had is not None:
        had.clearFocus()
    QCoreApplication.processEvents()
    return _light(top, widget) if isValid(widget) else np.zeros((0, 0))


def _light(top: QWidget, widget: QWidget) -> F64:
    """Return the relative luminance of a widget's pixels and of those round it."""
    place = QRect(widget.mapTo(top, QPoint(0, 0)), widget.size()).adjusted(-4, -4, 4, 4).intersected(top.rect())
    image = top.grab(place).toImage().convertToFormat(QImage.Format.Format_RGB32)
    high, wide = image.height(), image.width()
    bgr = np.frombuffer(image.constBits(), np.uint8).reshape(high, image.bytesPerLine() // 4, 4)[:, :wide, :3] / 255.0
    linear = np.where(bgr <= 0.03928, bgr / 12.92, ((bgr + 0.055) / 1.055) ** 2.4)
    return np.asarray(linear @ np.array([0.0722, 0.7152, 0.2126]))
