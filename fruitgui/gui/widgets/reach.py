"""What scrolls is scrolled by a finger anywhere on it, and shows when the keyboard is there."""

from __future__ import annotations

from PySide6.QtWidgets import QAbstractItemView, QAbstractScrollArea, QScroller, QScrollerProperties

from fruitgui.gui.widgets.focus import FocusRing
from fruitgui.gui.widgets.tapped import TapChooses


def reach(area: QAbstractScrollArea) -> None:
    """Let finger and keyboard reach something that scrolls: a scroll bar is too thin for a glove."""
    FocusRing(area)
    scrolled_by_finger(area)
    if isinstance(area, QAbstractItemView):
        TapChooses(area)


def scrolled_by_finger(area: QAbstractScrollArea) -> None:
    """Let a finger that moves over something scroll it; one that taps presses as ever."""
    QScroller.grabGesture(area.viewport(), QScroller.ScrollerGestureType.TouchGesture)
    scroller = QScroller.scroller(area.viewport())
    properties = scroller.scrollerProperties()
    never = QScrollerProperties.OvershootPolicy.OvershootAlwaysOff
    for metric in (
        QScrollerProperties.ScrollMetric.HorizontalOvershootPolicy,
        QScrollerProperties.ScrollMetric.VerticalOvershootPolicy,
    ):
        properties.setScrollMetric(metric, never)
    scroller.setScrollerProperties(properties)
