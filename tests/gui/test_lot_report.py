"""The report on a lot as PDF."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from fruitgui.errors import CancelledByUserError, InputError, WorldError
from fruitgui.gui.steps.lots.report import write_report
from fruitgui.gui.steps.lots.sheet import Sheet
from fruitgui.gui.translate import Language
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import LotPlan
from fruitgui.records.store import Store, open_store
from fruitgui.station.live.blind import Blind
from tests.gui.lots_made import START_S, Clock, run
from tests.unit.records.test_lots_screen import station_text

pytestmark = pytest.mark.usefixtures("theme")


@pytest.fixture
def clock() -> Clock:
    return Clock(START_S)


@pytest.fixture
def store(tmp_path: Path, clock: Clock) -> Iterator[Store]:
    with open_store(tmp_path, clock) as opened:
        yield opened


@pytest.fixture
def said(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return what is written on the sheets, in order; glyphs in the file itself have no letters."""
    words: list[str] = []
    plain = Sheet.text

    def noted(self: Sheet, box: object, text: str, *style: object, **more: object) -> None:
        words.append(text)
        plain(self, box, text, *style, **more)  # type: ignore[arg-type]

    monkeypatch.setattr(Sheet, "text", noted)
    return words


def _pages(path: Path) -> int:
    return len(re.findall(rb"/Type /Page\b", path.read_bytes()))


def test_the_report_says_lot_sums_spread_corrections_and_method(
    store: Store, clock: Clock, tmp_path: Path, said: list[str]
) -> None:
    lot = run(store, clock, "1184", "Fundo El Peñón", 200)
    keys = [one.key for one in store.fruit.find(FruitQuery(lot)).fruit]
    store.corrections.leave_out(keys[:2])
    store.corrections.name(keys[2:5], "quince")
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    assert _pages(tmp_path / "a.pdf") == 2
    text = "\n".join(said)
    for part in (
        "Lot 1184", "Fundo El Peñón", "Export A", "198", "Quince", "Volume, ml", "Diameter, mm", "Mass, g",
        "Of 200 fruit, people corrected 5: they left out 2", "left out", "half the width of a 95 % interval",
        "what fruit err by together", "as of the kind that the machine said",
        "Kinds by model model-0003; frame of reference: sensor kinect_1.",
    ):  # fmt: skip
        assert part in text, part
    assert len([line for line in said if "±" in line and "\u2009l" in line]) >= 5


def test_the_report_says_when_not_all_of_the_belt_was_seen(
    store: Store, clock: Clock, tmp_path: Path, said: list[str]
) -> None:
    lot = store.lots.start(LotPlan("1184")).key
    store.spells.note(lot, Blind(("kinect_2",), ((0.41, 0.65),), 0.65, 0.3))
    clock.now_s += 37.0
    store.spells.note(lot, None)
    store.lots.end(lot)
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    words = "\n".join(said).replace("\u2009", " ")
    assert "Not seen" in words
    assert "fruit may have passed unseen" in words
    assert "37 s" in words
    assert "kinect_2 away" in words


def test_the_report_says_when_the_rig_was_moved(store: Store, clock: Clock, tmp_path: Path, said: list[str]) -> None:
    lot = store.lots.start(LotPlan("1184")).key
    store.spells.note_moved(lot, ("kinect_2",))
    store.lots.end(lot)
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    words = " ".join(said)
    assert "In doubt" in words
    assert "(kinect_2): sizes and counts may be wrong" in words
    assert "Not seen" not in words


def test_every_page_is_a4(store: Store, clock: Clock, tmp_path: Path) -> None:
    lot = run(store, clock, "1184", "", 3)
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    boxes = re.findall(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", tmp_path.joinpath("a.pdf").read_bytes())
    assert boxes
    assert all((round(float(w)), round(float(h))) == (595, 842) for w, h in boxes)


def test_a_lot_of_nothing_is_reported_too(store: Store, clock: Clock, tmp_path: Path, said: list[str]) -> None:
    lot = run(store, clock, "empty", "", 0)
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    assert _pages(tmp_path / "a.pdf") == 1
    assert "Nobody corrected anything; all figures are the machine's." in said


def test_where_fruit_were_left_out_only_measures_are_no_question(
    store: Store, clock: Clock, tmp_path: Path, said: list[str]
) -> None:
    lot = run(store, clock, "1184", "", 5)
    store.corrections.leave_out([store.fruit.find(FruitQuery(lot)).fruit[0].key])
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    assert "as of the kind that the machine said" not in "\n".join(said)


def test_many_corrections_go_over_pages_and_are_cut_openly(
    store: Store, clock: Clock, tmp_path: Path, said: list[str]
) -> None:
    lot = run(store, clock, "1184", "", 90)
    store.corrections.leave_out([one.key for one in store.fruit.find(FruitQuery(lot)).fruit])
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    assert _pages(tmp_path / "a.pdf") >= 2
    assert "And 30 more; the table of all fruit (CSV) has every one." in said


def test_it_speaks_the_windows_language(
    qapp: QApplication, store: Store, clock: Clock, tmp_path: Path, said: list[str]
) -> None:
    lot = run(store, clock, "1184", "", 5)
    language = Language()
    language.put_on(qapp, "es")
    try:
        write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    finally:
        language.put_on(qapp, "en")
    assert "Lote 1184" in said
    assert not {"Grower", "Kind", "Fruit", "How it was measured"} & set(said)


def test_what_cannot_be_written_leaves_nothing(store: Store, clock: Clock, tmp_path: Path) -> None:
    lot = run(store, clock, "1184", "", 5)
    with pytest.raises(WorldError):
        write_report(store, lot, tmp_path / "missing" / "a.pdf", clock.now_s)
    with pytest.raises(InputError):
        write_report(store, 99, tmp_path / "a.pdf", clock.now_s)
    with pytest.raises(CancelledByUserError):
        write_report(store, lot, tmp_path / "a.pdf", clock.now_s, cancelled=lambda: True)
    assert list(tmp_path.glob("*.pdf")) == []
    assert list(tmp_path.glob(".a.pdf*")) == []


def test_the_report_tells_which_device_each_sensor_was(
    store: Store, clock: Clock, tmp_path: Path, said: list[str]
) -> None:
    text = station_text({"left": "A22595U34223", "right": ""})
    lot = store.lots.start(LotPlan("1184", station_text=text)).key
    write_report(store, lot, tmp_path / "a.pdf", clock.now_s)
    assert "the devices: left (A22595U34223)." in " ".join(said)
