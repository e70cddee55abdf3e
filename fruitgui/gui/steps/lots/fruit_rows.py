"""The fruit of a lot as a table: its columns, what stands in them, and which fruit are wanted."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text, percent_text
from fruitgui.gui.steps.lots.words import NONE, measure_text
from fruitgui.gui.theme.kinds import UNKNOWN
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.records.fruit_search import FruitQuery, Order, Which

translate = QCoreApplication.translate


class Column(StrEnum):
    """The columns, each by what it is sorted by; `picture` is not sorted."""

    PICTURE = "picture"
    NUMBER = "number"
    KIND = "kind"
    SURE = "kind_probability"
    VOLUME = "volume_m3"
    MASS = "mass_kg"
    DIAMETER = "diameter_m"
    LENGTH = "length_m"
    VIEWS = "views"

    @property
    def order(self) -> Order | None:
        """What the records are sorted by for this column."""
        return _ORDERS.get(self)


_ORDERS: dict[Column, Order] = {
    Column.NUMBER: "number", Column.KIND: "kind", Column.SURE: "kind_probability", Column.VOLUME: "volume_m3",
    Column.MASS: "mass_kg", Column.DIAMETER: "diameter_m", Column.LENGTH: "length_m", Column.VIEWS: "views",
}  # fmt: skip

COLUMNS = tuple(Column)

FALLS_FIRST = {Column.VOLUME, Column.MASS, Column.DIAMETER, Column.LENGTH, Column.VIEWS}
"""Columns that begin with the largest when they are pressed; the others begin with the smallest."""


class Show(StrEnum):
    """Which fruit are shown: the least sure among them are found by sorting."""

    COUNTED = "counted"
    UNKNOWN = "unknown"
    CORRECTED = "corrected"
    LEFT_OUT = "left_out"


@dataclass(frozen=True, slots=True)
class Wanted:
    """What the table shows: of which lot, which fruit, of which kind (None for all), in which order."""

    lot: int
    show: Show = Show.COUNTED
    kind: str | None = None
    column: Column = Column.NUMBER
    falling: bool = False

    def query(self, page: int, size: int) -> FruitQuery:
        """Return the question for one page."""
        which: Which = {Show.CORRECTED: "corrected", Show.LEFT_OUT: "left_out"}.get(self.show, "counted")  # type: ignore[assignment]
        kind = UNKNOWN if self.show is Show.UNKNOWN else self.kind
        order = self.column.order or "number"
        return FruitQuery(self.lot, kind, which, order, self.falling, page * size, size)


def show_word(show: Show) -> str:
    """Return which fruit are shown, in words."""
    return {
        Show.COUNTED: translate("Lots", "All that count"),
        Show.UNKNOWN: translate("Lots", "Unknown"),
        Show.CORRECTED: translate("Lots", "Corrected"),
        Show.LEFT_OUT: translate("Lots", "Left out"),
    }[show]


def column_word(column: Column) -> str:
    """Return the head of a column."""
    return {
        Column.PICTURE: "",
        Column.NUMBER: translate("Lots", "No."),
        Column.KIND: translate("Lots", "Kind"),
        Column.SURE: translate("Lots", "Sure"),
        Column.VOLUME: translate("Lots", "Volume"),
        Column.MASS: translate("Lots", "Mass"),
        Column.DIAMETER: translate("Lots", "Diameter"),
        Column.LENGTH: translate("Lots", "Length"),
        Column.VIEWS: translate("Lots", "Views"),
    }[column]


def cell_text(fruit: FruitRecord, column: Column) -> str:
    """Return what stands in a cell."""
    if column is Column.PICTURE:
        return ""
    if column is Column.NUMBER:
        return count_text(fruit.number)
    if column is Column.KIND:
        return kind_name(fruit.kind)
    if column is Column.SURE:
        return NONE if fruit.kind_probability is None else percent_text(fruit.kind_probability)
    if column is Column.VIEWS:
        return count_text(fruit.views)
    return {
        Column.VOLUME: lambda: measure_text("volume_m3", fruit.volume_m3),
        Column.MASS: lambda: measure_text("mass_kg", fruit.mass_kg),
        Column.DIAMETER: lambda: measure_text("diameter_m", fruit.diameter_m),
        Column.LENGTH: lambda: measure_text("length_m", fruit.length_m),
    }[column]()


def correction_text(fruit: FruitRecord) -> str:
    """Return how a fruit differs from what the machine said; empty where it does not."""
    if fruit.machine_kind is None:
        return translate("Lots", "added by hand")
    said = "" if fruit.kind == fruit.machine_kind else kind_name(fruit.machine_kind)
    machine = translate("Lots", "machine: {kind}").format(kind=said) if said else ""
    left_out = "" if fruit.counted else translate("Lots", "left out")
    return " · ".join(part for part in (left_out, machine) if part)
