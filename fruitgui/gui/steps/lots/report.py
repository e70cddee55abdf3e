"""The report on a lot that one hands to a grower: A4, sober, in the window's language."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QRectF

from fruitgui.files import written_whole
from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text, shares_text
from fruitgui.gui.steps.lots.figures import model_name, of_text, spans, spell_texts, trouble_text, unseen_text
from fruitgui.gui.steps.lots.report_spreads import section, write_spreads
from fruitgui.gui.steps.lots.sheet import BODY, BODY_DIM, DIM, SMALL, STRONG, TITLE, Sheet
from fruitgui.gui.steps.lots.words import NONE, kilograms_text, litres_text, measure_text
from fruitgui.gui.theme.kinds import UNKNOWN, KindMark, kind_marks
from fruitgui.gui.times import duration_text, moment_text
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot_report import LotReport, report_lot
from fruitgui.records.store import Store

translate = QCoreApplication.translate

COLUMNS_PT = (0.24, 0.09, 0.10, 0.18, 0.19, 0.20)
"""Shares of the width that the columns of the table of kinds have."""

LISTED_PT = (0.14, 0.2, 0.06, 0.3, 0.3)
"""The same of the list of corrected fruit."""

UNSEEN_PT = (0.22, 0.12, 0.02, 0.64)
"""And of the list of times in which sensors were away."""

MOST_LISTED = 60

READING = "reading"


def doing_words(doing: str) -> str:
    """Return what of the report is being done: the lot is read, or else a file is written, which is named."""
    return translate("LotReport", "Reading the lot") if doing == READING else doing


def write_report(
    store: Store, lot: int, path: Path, now_s: float, marks: Sequence[KindMark] = (),
    progress: Progress = no_progress, cancelled: Cancelled = never_cancelled,
) -> None:  # fmt: skip
    """Write the report on a lot as it is now, whole or not at all; kinds keep the marks that they have.

    Raises:
        InputError: there is no such lot.
        WorldError: it cannot be read or written.
        CancelledByUserError: a person stopped it; no file is left.
    """
    progress(0.0, READING)
    report = report_lot(store, lot, now_s)
    unknown = store.fruit.find(FruitQuery(lot, kind=UNKNOWN, count=0)).found
    corrected = store.fruit.find(FruitQuery(lot, which="corrected", count=MOST_LISTED)).fruit
    looks = kind_marks([one.kind for one in report.kinds], marks)
    stop_if(cancelled)
    progress(0.7, path.name)
    with written_whole(path) as beside:
        title = translate("LotReport", "Lot {name}").format(name=report.lot.name)
        sheet = Sheet(beside, title, translate("LotReport", "Page {page}"))
        try:
            _write_head(sheet, report)
            _write_sums(sheet, report, looks)
            write_spreads(sheet, report, looks)
            _write_unseen(sheet, report)
            _write_corrections(sheet, report, unknown, corrected)
            _write_method(sheet, report)
        finally:
            sheet.close()
    progress(1.0, path.name)


def _write_head(sheet: Sheet, report: LotReport) -> None:
    lot = report.lot
    sheet.words(translate("LotReport", "Report on a lot of fruit"), SMALL)
    sheet.words(translate("LotReport", "Lot {name}").format(name=lot.name), TITLE)
    sheet.skip(6)
    end = NONE if lot.ended_s is None else moment_text(lot.ended_s)
    still_s = sum(span.to_s - span.from_s for span in spans(lot, report.made_s) if span.why)
    rows = [
        (translate("LotReport", "Grower"), lot.grower),
        (translate("LotReport", "Recipe"), lot.recipe),
        (translate("LotReport", "Started"), moment_text(lot.started_s)),
        (translate("LotReport", "Ended"), end if lot.ended_s else translate("LotReport", "not ended yet")),
        (translate("LotReport", "Ran"), duration_text(report.ran_s)),
        (translate("LotReport", "Stood still"), duration_text(still_s) if still_s else ""),
        (translate("LotReport", "Note"), lot.note),
        (translate("LotReport", "Report made"), moment_text(report.made_s)),
    ]
    for name, text in rows:
        if text:
            sheet.text(QRectF(0, sheet.y, 90, 15), name, BODY_DIM)
            sheet.text(QRectF(90, sheet.y, sheet.width - 90, 15), sheet.elided(text, BODY, sheet.width - 90), BODY)
            sheet.skip(15)
    sheet.skip(10)


def _write_sums(sheet: Sheet, report: LotReport, marks: Mapping[str, KindMark]) -> None:
    section(sheet, translate("LotReport", "Counts and volumes"))
    widths = [share * sheet.width for share in COLUMNS_PT]
    heads = (
        translate("LotReport", "Kind"), translate("LotReport", "Fruit"), translate("LotReport", "Share"),
        translate("LotReport", "Mean volume"), translate("LotReport", "Total volume"),
        translate("LotReport", "Total mass"),
    )  # fmt: skip
    sheet.row(heads, widths, SMALL)
    for one, share in zip(report.kinds, shares_text([one.fruit for one in report.kinds]), strict=True):
        sheet.line(0, sheet.width)
        sheet.room(17)
        mark = marks.get(one.kind)
        if mark is not None:
            painter, box = sheet.painter_at(QRectF(0, sheet.y + 2.5, 12, 12))
            paint_mark(painter, box, mark)
        texts = (
            kind_name(one.kind), count_text(one.fruit), share,
            measure_text("volume_m3", one.mean_volume_m3), litres_text(one.volume_m3 if one.measured else None),
            kilograms_text(one.mass_kg if one.weighed else None),
        )  # fmt: skip
        sheet.row((f"      {texts[0]}", *texts[1:]), widths)
    sheet.line(0, sheet.width, DIM)
    total = (
        translate("LotReport", "All kinds"), count_text(report.fruit), "", "",
        litres_text(report.volume_m3 if report.measured else None),
        kilograms_text(report.mass_kg if report.weighed else None),
    )  # fmt: skip
    sheet.row(total, widths, STRONG)
    for what, some in (
        (translate("LotReport", "Volumes are sums {of}."), report.measured),
        (translate("LotReport", "Masses are sums {of}, of known density."), report.weighed),
    ):
        of = of_text(some, report.fruit)
        if of:
            sheet.words(what.format(of=of), SMALL)
    sheet.skip(12)


def _write_corrections(sheet: Sheet, report: LotReport, unknown: int, corrected: Sequence[FruitRecord]) -> None:
    section(sheet, translate("LotReport", "Corrected by hand"))
    if report.corrected:
        renamed = report.corrected - report.left_out
        text = translate(
            "LotReport",
            "Of {all} fruit, people corrected {count}: they left out {left_out} and gave {named} another kind, or "
            "added it. The figures above hold what people said; what the machine said is kept beside it.",
        )
        text = text.format(
            all=count_text(report.fruit + report.left_out), count=count_text(report.corrected),
            left_out=count_text(report.left_out), named=count_text(renamed),
        )  # fmt: skip
    else:
        text = translate("LotReport", "Nobody corrected anything; all figures are the machine's.")
    sheet.words(text)
    if unknown:
        text = translate(
            "LotReport", "{count} fruit are of no kind that the machine was taught; they count as unknown."
        )
        sheet.words(text.format(count=count_text(unknown)))
    if report.corrected > report.left_out:
        sheet.words(
            translate(
                "LotReport",
                "Volume and mass of a fruit that people gave another kind stay as they were measured: as of the kind "
                "that the machine said.",
            )
        )
    _list_corrected(sheet, report, corrected)
    sheet.skip(12)


def _write_unseen(sheet: Sheet, report: LotReport) -> None:
    """Write when not all of the belt was seen: who is handed a count is told what it may lack."""
    lot = report.lot
    trouble = trouble_text(lot)
    if trouble:
        section(sheet, translate("LotReport", "In doubt"))
        sheet.words(f"{trouble}.")
        sheet.skip(12)
    if not lot.spells:
        return
    section(sheet, translate("LotReport", "Not seen"))
    sheet.words(unseen_text(lot, report.made_s))
    sheet.skip(4)
    widths = [share * sheet.width for share in UNSEEN_PT]
    for when, lasted, what in spell_texts(lot, report.made_s, MOST_LISTED):
        sheet.room(15)
        sheet.line(0, sheet.width)
        sheet.row((when, lasted, "", sheet.elided(what, BODY, widths[3])), widths, BODY, 15, left=(0, 3))
    more = len(lot.spells) - MOST_LISTED
    if more > 0:
        text = translate("LotReport", "And {count} shorter ones.")
        sheet.words(text.format(count=count_text(more)), SMALL)
    sheet.skip(12)


def _list_corrected(sheet: Sheet, report: LotReport, corrected: Sequence[FruitRecord]) -> None:
    """Write a row for each fruit that people corrected, as many as a report is read for."""
    if not corrected:
        return
    sheet.skip(4)
    widths = [share * sheet.width for share in LISTED_PT]
    heads = (
        translate("LotReport", "Fruit No."),
        translate("LotReport", "Volume"),
        "",
        translate("LotReport", "The machine said"),
        translate("LotReport", "A person said"),
    )
    sheet.row(heads, widths, SMALL, 14, left=(0, 3, 4))
    for one in corrected:
        machine = translate("LotReport", "not seen") if one.machine_kind is None else kind_name(one.machine_kind)
        person = kind_name(one.kind) if one.counted else translate("LotReport", "left out")
        sheet.room(15)
        sheet.line(0, sheet.width)
        volume = measure_text("volume_m3", one.volume_m3)
        sheet.row((count_text(one.number), volume, "", machine, person), widths, BODY, 15, left=(0, 3, 4))
    more = report.corrected - len(corrected)
    if more > 0:
        text = translate("LotReport", "And {count} more; the table of all fruit (CSV) has every one.")
        sheet.words(text.format(count=count_text(more)), SMALL)


def _write_method(sheet: Sheet, report: LotReport) -> None:
    sheet.room(110)
    section(sheet, translate("LotReport", "How it was measured"))
    sheet.words(
        translate(
            "LotReport",
            "Every fruit was followed over the belt by sensors that see colour and depth, counted once, and measured "
            "from all views together: a closed surface through what was seen gives volume, length and diameter. "
            "Nothing was weighed; a mass is the volume times the density of its kind, where that is known.",
        )
    )
    sheet.words(
        translate(
            "LotReport",
            "± is half the width of a 95 % interval. In that of totals and means the errors of single fruit average "
            "out; what fruit err by together, such as the sensors' scale, the correction of a kind, or its density, "
            "does not, and is in it whole.",
        )
    )
    lot = report.lot
    if lot.model or lot.reference_sensor:
        text = translate("LotReport", "Kinds by model {model}; frame of reference: sensor {sensor}.")
        sheet.words(text.format(model=model_name(lot.model) or NONE, sensor=lot.reference_sensor or NONE), SMALL)
    devices = [f"{name} ({serial})" for name, serial in report.serials.items() if serial]
    if devices:
        text = translate("LotReport", "Sensors, with the serials of the devices: {sensors}.")
        sheet.words(text.format(sensors=", ".join(devices)), SMALL)
