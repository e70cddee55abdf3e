"""How sizes are spread, as the report on a lot draws it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from PySide6.QtCore import QCoreApplication, QRectF, Qt

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text, number_text
from fruitgui.gui.steps.lots.sheet import LINE, SECTION, SMALL, STRONG, Sheet
from fruitgui.gui.steps.lots.words import SPREAD, UNITS, measure_name
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.widgets.histogram import ticks
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.records.distribution import Distribution
from fruitgui.records.lot_report import LotReport

translate = QCoreApplication.translate

PLOT_PT, AXIS_PT = 110.0, 14.0


def section(sheet: Sheet, title: str) -> None:
    """Write the title of a part."""
    sheet.room(40)
    sheet.words(title, SECTION)
    sheet.skip(2)


def write_spreads(sheet: Sheet, report: LotReport, marks: Mapping[str, KindMark]) -> None:
    """Write how each measure is spread over the fruit, two plots in a row, and what the colours are."""
    measured = [one for one in SPREAD if report.spread[one].edges.size]
    if not measured:
        return
    width = (sheet.width - 24) / 2
    sheet.room(24 + PLOT_PT + AXIS_PT + 34)
    section(sheet, translate("LotReport", "How the fruit are spread"))
    for number, one in enumerate(measured):
        if number % 2 == 0:
            sheet.room(PLOT_PT + AXIS_PT + 30)
        x = (number % 2) * (width + 24)
        _paint_spread(sheet, report.spread[one], marks, QRectF(x, sheet.y, width, PLOT_PT + AXIS_PT + 16))
        if number % 2 or number == len(measured) - 1:
            sheet.skip(PLOT_PT + AXIS_PT + 28)
    _write_legend(sheet, report, marks)


def _write_legend(sheet: Sheet, report: LotReport, marks: Mapping[str, KindMark]) -> None:
    x = 0.0
    sheet.room(16)
    for one in report.kinds:
        name = kind_name(one.kind)
        width = 16 + sheet.width_of(name, SMALL) + 14
        if x + width > sheet.width:
            x = 0.0
            sheet.skip(15)
            sheet.room(16)
        painter, box = sheet.painter_at(QRectF(x, sheet.y, 11, 11))
        paint_mark(painter, box, marks[one.kind])
        sheet.text(QRectF(x + 15, sheet.y, width, 12), name, SMALL, Qt.AlignmentFlag.AlignVCenter)
        x += width
    sheet.skip(26)


def _paint_spread(sheet: Sheet, spread: Distribution, marks: Mapping[str, KindMark], box: QRectF) -> None:
    factor, unit = UNITS[spread.measured]
    low, high = spread.edges[0] * factor, spread.edges[-1] * factor
    kinds = [kind for kind in marks if kind in spread.counts]
    most = int(np.sum([spread.counts[kind] for kind in kinds], axis=0).max(initial=1))
    sheet.text(QRectF(box.left(), box.top(), box.width(), 12), f"{measure_name(spread.measured)}, {unit}", STRONG)
    sheet.text(QRectF(box.left(), box.top(), box.width(), 12), count_text(most), SMALL, Qt.AlignmentFlag.AlignRight)
    plot = QRectF(box.left(), box.top() + 16, box.width(), PLOT_PT)
    bins = len(spread.edges) - 1
    floor = np.full(bins, plot.bottom())
    width = plot.width() / bins
    for kind in kinds:
        for at in np.flatnonzero(spread.counts[kind]).tolist():
            height = plot.height() * int(spread.counts[kind][at]) / most
            floor[at] -= height
            bar = QRectF(plot.left() + at * width + 0.25, floor[at], max(width - 0.5, 0.5), height)
            sheet.bar(bar, marks[kind].colour)
    sheet.bar(QRectF(plot.left(), plot.bottom(), plot.width(), 0.6), LINE)
    for value in ticks(low, high):
        x = plot.left() + plot.width() * (value - low) / (high - low)
        sheet.text(QRectF(x - 30, plot.bottom() + 2, 60, AXIS_PT), number_text(value, 0), SMALL,
                   Qt.AlignmentFlag.AlignHCenter)  # fmt: skip
