"""Everything that is known of one fruit, in words."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import THIN, count_text, number_text, percent_text
from fruitgui.gui.steps.lots.words import NONE, UNITS, measure_text
from fruitgui.gui.theme.kinds import UNKNOWN
from fruitgui.gui.times import moment_text
from fruitgui.records.correcting import Correction
from fruitgui.records.fruit_record import FruitRecord

translate = QCoreApplication.translate


def machine_text(fruit: FruitRecord) -> str:
    """Return what the machine said of a fruit, and how sure it was."""
    if fruit.machine_kind is None:
        return translate("Lots", "The machine missed this fruit; a person added it.")
    if fruit.machine_kind == UNKNOWN:
        return translate("Lots", "The machine did not know it.")
    sure = NONE if fruit.kind_probability is None else percent_text(fruit.kind_probability)
    return translate("Lots", "The machine said {kind}, {sure} sure.").format(
        kind=kind_name(fruit.machine_kind), sure=sure
    )


def person_text(fruit: FruitRecord) -> str:
    """Return what a person said against the machine; empty where nobody did."""
    parts = []
    if fruit.machine_kind is not None and fruit.kind != fruit.machine_kind:
        parts.append(translate("Lots", "A person named it {kind}.").format(kind=kind_name(fruit.kind)))
    if not fruit.counted:
        parts.append(translate("Lots", "A person left it out; it does not count."))
    return " ".join(parts)


def facts(fruit: FruitRecord) -> list[tuple[str, str]]:
    """Return what was measured of a fruit: what, and how much with ±."""
    paper = fruit.paper_volume_m3
    factor, unit = UNITS["volume_m3"]
    rows = [
        (translate("Lots", "Volume"), measure_text("volume_m3", fruit.volume_m3)),
        (translate("Lots", "uncorrected"), measure_text("volume_m3", fruit.fitted_volume_m3)),
        (translate("Lots", "by the paper"), NONE if paper is None else f"{number_text(paper * factor, 1)}{THIN}{unit}"),
        (translate("Lots", "Mass"), measure_text("mass_kg", fruit.mass_kg)),
        (translate("Lots", "Diameter"), measure_text("diameter_m", fruit.diameter_m)),
        (translate("Lots", "Length"), measure_text("length_m", fruit.length_m)),
        (translate("Lots", "Perimeter"), measure_text("perimeter_m", fruit.perimeter_m)),
        (translate("Lots", "Seen"), _seen(fruit)),
        (translate("Lots", "Counted"), moment_text(fruit.counted_s)),
        (translate("Lots", "Outlet"), fruit.outlet or NONE),
    ]
    optional = {translate("Lots", "uncorrected"), translate("Lots", "by the paper"), translate("Lots", "Outlet")}
    return [(name, value) for name, value in rows if value != NONE or name not in optional]


def _seen(fruit: FruitRecord) -> str:
    if fruit.coverage is None:
        return NONE if not fruit.views else translate("Lots", "{views} views").format(views=count_text(fruit.views))
    text = translate("Lots", "{share} of its surface, {views} views")
    return text.format(share=percent_text(fruit.coverage), views=count_text(fruit.views))


def said_lines(corrections: Sequence[Correction]) -> list[str]:
    """Return all that people said of a fruit, the newest first."""
    return [_said(one) for one in reversed(corrections)]


def _said(one: Correction) -> str:
    if one.counted is not None and not one.counted:
        what = translate("Lots", "left out")
    elif one.counted:
        what = translate("Lots", "counts")
    else:
        what = kind_name(one.kind or "")
    note = f" “{one.note}”" if one.note else ""
    who = f" ({one.who})" if one.who else ""
    return f"{moment_text(one.when_s)}: {what}{note}{who}"
