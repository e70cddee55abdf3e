"""The summary of a lot in windows of every height: laying it out ends, and nothing is cut off where there is room."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from fruitgui.gui.steps.lots.figures import LotFigures
from fruitgui.gui.steps.lots.summary import Summary
from fruitgui.gui.theme.kinds import kind_marks
from fruitgui.gui.theme.theme import Theme
from fruitgui.measurement.sums import SharedSum
from fruitgui.records.lot import Lot
from fruitgui.records.spells import Spell
from fruitgui.records.totals import KindTotal
from fruitgui.station.live.blind import Blind

NOW_S = 9000.0
KINDS = ("lemon", "red apple", "green apple", "avocado", "quince")
AWAY = Spell(10.0, 47.0, Blind(("kinect_1",), ((0.0, 0.2),), 0.6, 0.3))


def _figures(kinds: int, spells: tuple[Spell, ...]) -> LotFigures:
    lot = Lot(1, "1184", "Fundo", "", "", "kinect_1", None, None, {}, (), 0.0, NOW_S, (), spells)
    volume, mass = SharedSum(1e-3, 1e-12, 1e-6, 1e-13), SharedSum(1.0, 1e-6, 1e-3, 1e-7)
    totals = tuple(KindTotal(kind, 5, 5, volume, 1e-5, 5, mass) for kind in KINDS[:kinds])
    return LotFigures(lot, totals, 0, 0, NOW_S)


@pytest.mark.parametrize("spells", [(), (AWAY,)], ids=["all seen", "some unseen"])
@pytest.mark.parametrize("kinds", [1, 5])
def test_laying_out_ends_at_every_size(
    qtbot: QtBot, theme: Theme, qapp: QApplication, kinds: int, spells: tuple[Spell, ...]
) -> None:
    """Words that wrap in a scroll area once filled the stack, and the program was gone."""
    summary = Summary(theme)
    qtbot.addWidget(summary)
    summary.resize(724, 495)
    summary.show_figures(_figures(kinds, spells), kind_marks(KINDS))
    summary.show()
    for width in (560, 724, 1300):
        for height in (*range(300, 640, 9), 1000):
            summary.resize(width, height)
            qapp.processEvents()
            inside = summary.widget()
            assert inside is not None
            assert inside.height() >= summary.viewport().height()


def test_words_take_no_more_height_than_they_need_once_there_is_room(
    qtbot: QtBot, theme: Theme, qapp: QApplication
) -> None:
    summary = Summary(theme)
    qtbot.addWidget(summary)
    summary.resize(100, 495)
    summary.show_figures(_figures(5, (AWAY,)), kind_marks(KINDS))
    summary.show()
    qapp.processEvents()
    narrow = summary.unseen.height()
    summary.resize(724, 495)
    qapp.processEvents()
    line = summary.unseen.fontMetrics().lineSpacing()
    assert summary.unseen.height() <= 2 * line < narrow


def test_all_is_in_view_in_the_least_window(qtbot: QtBot, theme: Theme, qapp: QApplication) -> None:
    summary = Summary(theme)
    qtbot.addWidget(summary)
    summary.resize(724, 495)
    summary.show_figures(_figures(5, (AWAY,)), kind_marks(KINDS))
    summary.show()
    qapp.processEvents()
    assert summary.verticalScrollBar().maximum() == 0
    histogram = next(iter(summary.spreads.histograms.values()))
    assert histogram.height() >= histogram.minimumHeight()


def test_a_warning_of_two_rows_makes_nothing_scroll_in_the_least_window(
    qtbot: QtBot, theme: Theme, qapp: QApplication
) -> None:
    summary = Summary(theme)
    qtbot.addWidget(summary)
    summary.resize(724, 495)
    few = Spell(60.0, 90.0, Blind(("kinect_2",), ((0.0, 0.2),), 0.6, 0.3), "sparse")
    summary.show_figures(_figures(5, (AWAY, few)), kind_marks(KINDS))
    summary.show()
    qapp.processEvents()
    assert summary.unseen.height() > 1.5 * summary.unseen.fontMetrics().lineSpacing()
    assert summary.verticalScrollBar().maximum() == 0
    histogram = next(iter(summary.spreads.histograms.values()))
    assert histogram.height() >= histogram.minimumHeight()
