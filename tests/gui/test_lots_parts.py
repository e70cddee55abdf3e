"""The parts of the lots screen that have no widgets."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import date, datetime
from pathlib import Path

import cv2
import numpy as np
import pytest

from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.gui.kind_words import kind_name, kinds_in_order
from fruitgui.gui.steps.lots.figures import (
    kind_rows,
    read_figures,
    spans,
    spell_texts,
    times_text,
    trouble_text,
    unseen_text,
)
from fruitgui.gui.steps.lots.fruit_facts import facts, machine_text, person_text, said_lines
from fruitgui.gui.steps.lots.fruit_pictures import way
from fruitgui.gui.steps.lots.fruit_rows import Column, Show, Wanted, cell_text, correction_text
from fruitgui.gui.steps.lots.hand import Deed, Undo, Word, undoing
from fruitgui.gui.steps.lots.handing_on import file_name
from fruitgui.gui.steps.lots.lot_entry import LotState, Period, bounds_s, lot_entry, state_of
from fruitgui.gui.steps.lots.paged import Pages
from fruitgui.gui.steps.lots.spreads import columns_for
from fruitgui.gui.steps.lots.words import litres_text, quantity_text
from fruitgui.gui.times import clock_text, duration_text, second_text
from fruitgui.gui.view_pictures import view_pictures
from fruitgui.measurement.fruit import Quantity
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import Lot, LotPlan, Pause
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.spells import Spell, Trouble
from fruitgui.records.store import Store, open_store
from fruitgui.station.live.blind import Blind
from fruitgui.station.station import Station, StationSensor
from fruitgui.tracking.track import PathPoint
from tests.gui.lots_made import START_S, Clock, crops, run
from tests.unit.station.fruit_made import made_fruit


@pytest.fixture
def clock() -> Clock:
    return Clock(START_S)


@pytest.fixture
def store(tmp_path: Path, clock: Clock) -> Iterator[Store]:
    with open_store(tmp_path, clock) as opened:
        yield opened


def _lot(**changes: object) -> Lot:
    plain = Lot(1, "1184", "", "", "", "", None, None, {}, (), 1000.0, None, ())
    return replace(plain, **changes)  # type: ignore[arg-type]


# pages


def test_pages_are_wanted_once_as_they_come_into_view() -> None:
    pages: Pages[int] = Pages(size=10, most=2)
    pages.clear(95)
    assert pages.wanted(0, 12) == 0
    pages.put(0, range(10), 95)
    assert pages.wanted(0, 12) == 1
    pages.put(1, range(10, 20), 95)
    assert pages.wanted(0, 12) is None
    assert (pages.row(13), pages.row(25)) == (13, None)
    assert pages.wanted(88, 200) == 8
    pages.put(9, range(90, 95), 95)
    assert pages.wanted(0, 5) == 0, "the one that was looked at longest ago is let go"
    assert pages.row(99) is None


def test_a_stale_page_is_shown_until_it_comes_again() -> None:
    pages: Pages[str] = Pages(size=2)
    pages.put(0, "ab", 2)
    pages.make_stale()
    assert (pages.row(1), pages.wanted(0, 1)) == ("b", 0)
    pages.put(0, "ac", 2)
    assert (pages.row(1), pages.wanted(0, 1)) == ("c", None)


# numbers and times


def test_sums_are_written_with_half_their_95_percent_interval() -> None:
    assert litres_text(Quantity(0.14012, 0.0000502)) == "140.12 ± 0.10\u2009l"
    assert quantity_text(Quantity(112e-6, 2.04e-6), 1e6, "ml") == "112 ± 4\u2009ml"
    assert quantity_text(None, 1.0, "g") == "–"
    assert quantity_text(Quantity(3.0, float("nan")), 1.0, "g") == "3.0\u2009g", "what is not known is not claimed"


@pytest.mark.parametrize(("seconds", "text"), [(0, "0 s"), (119, "119 s"), (120, "2 min"), (7260, "2 h 1 min")])
def test_durations(seconds: float, text: str) -> None:
    assert duration_text(seconds).replace("\u2009", " ") == text


def test_the_time_of_a_lot_is_cut_into_what_ran_and_what_stood_still() -> None:
    lot = _lot(pauses=(Pause(1600.0, 1700.0, "asked"), Pause(1900.0, None, "belt cleaned")))
    parts = spans(lot, 2200.0)
    assert [(one.from_s, one.to_s, one.why) for one in parts] == [
        (1000.0, 1600.0, ""), (1600.0, 1700.0, "paused"), (1700.0, 1900.0, ""), (1900.0, 2200.0, "belt cleaned"),
    ]  # fmt: skip
    assert sum(one.to_s - one.from_s for one in parts if not one.why) == lot.ran_s(2200.0)
    assert "2 pauses, together 7\u2009min" in times_text(lot, 2200.0)


def test_what_was_not_seen_is_said_with_how_long_and_who_was_away() -> None:
    left, less = Blind(("kinect_2",), ((0.41, 0.65),), 0.65, 0.3), Blind(("kinect_1",), (), 0.65, 0.0)
    lot = _lot(spells=(Spell(1100.0, 1137.0, left), Spell(1200.0, 1500.0, less), Spell(2000.0, None, left)))
    text = unseen_text(lot, 2010.0).replace("\u2009", " ")
    assert text == (
        "For 47 s (2×, kinect_2) fruit may have passed unseen; for 5 min (1×, kinect_1) sizes are less sure"
    )
    told = spell_texts(lot, 2010.0, 2)
    assert [lasted.replace("\u2009", " ") for _, lasted, _ in told] == ["37 s", "5 min"], "the longest, in order"
    assert "kinect_2 away: no sensor sees the left part" in told[0][2]
    assert unseen_text(_lot(), 2010.0) == ""


def test_what_was_seen_too_seldom_is_said_apart() -> None:
    left, less = Blind(("kinect_2",), ((0.41, 0.65),), 0.65, 0.3), Blind(("kinect_1",), (), 0.65, 0.0)
    spells = (Spell(1100.0, 1137.0, less, "sparse"), Spell(1200.0, 1260.0, left, "sparse"), Spell(2000.0, None, left))
    text = unseen_text(_lot(spells=spells), 2010.0).replace("\u2009", " ")
    assert text == (
        "For 10 s (1×, kinect_2) fruit may have passed unseen; "
        "for 60 s (1×, kinect_2) few pictures came, fruit may be missing; "
        "for 37 s (1×, kinect_1) few pictures came, sizes are less sure"
    )
    (_, _, told), *_ = spell_texts(_lot(spells=spells), 2010.0, 3)
    assert "too few pictures at this speed" in told


def test_a_moved_rig_and_clocks_that_leapt_are_said_with_who_it_was() -> None:
    moved = Trouble("moved", 1100.0, None, ("kinect_2",))
    leaps = [Trouble("clock_jumped", at_s, at_s, ("kinect_1",)) for at_s in (1200.0, 1300.0)]
    text = trouble_text(_lot(troubles=(moved, *leaps)))
    assert text == (
        f"Moved since calibrated, from {second_text(1100.0)} on (kinect_2): sizes and counts may be wrong. "
        "Clocks leapt 2× (kinect_1): fruit of that moment may be missing or twice"
    )
    assert trouble_text(_lot()) == ""


def test_it_is_said_at_what_times_most_fruit_were_unknown() -> None:
    times_s = (1100.0, 1900.0, 2800.0, 3700.0)
    unknown = tuple(Trouble("mostly_unknown", at_s, at_s, ()) for at_s in times_s)
    first, second, third, _ = (clock_text(at_s) for at_s in times_s)
    assert trouble_text(_lot(troubles=unknown[:1])) == (
        f"Most fruit were unknown to the model at {first}: kinds may lack fruit"
    )
    assert f"at {first}, {second}, {third} …: kinds" in trouble_text(_lot(troubles=unknown))


def test_it_is_said_at_what_times_the_line_broke_off() -> None:
    broken_off = (Trouble("line_begun_again", 1100.0, 1100.0, ()),)
    assert trouble_text(_lot(troubles=broken_off)) == (
        f"The line broke off at {clock_text(1100.0)} and went on: fruit in view then may be missing"
    )


def test_a_lot_is_running_paused_left_open_or_ended() -> None:
    still = _lot(pauses=(Pause(1100.0, None, "asked"),))
    assert state_of(_lot(), 1) is LotState.RUNNING
    assert state_of(still, 1) is LotState.PAUSED
    assert state_of(_lot(), None) is LotState.OPEN
    assert state_of(still, 2) is LotState.OPEN
    assert state_of(_lot(ended_s=2000.0), 1) is LotState.ENDED


def test_periods_are_whole_days_of_the_floors_own_time() -> None:
    today = date(2026, 3, 14)
    first, last = bounds_s(Period.WEEK, today, (today, today))
    assert first == datetime(2026, 3, 8).timestamp()
    assert last == pytest.approx(datetime(2026, 3, 15).timestamp(), abs=0.01)
    assert bounds_s(Period.ANY, today, (today, today)) == (None, None)
    swapped = bounds_s(Period.CHOSEN, today, (date(2026, 3, 3), date(2026, 3, 1)))
    assert swapped == bounds_s(Period.CHOSEN, today, (date(2026, 3, 1), date(2026, 3, 3)))


# a lot


def test_figures_are_those_of_the_store(store: Store, clock: Clock) -> None:
    lot = run(store, clock, "1184", "Riquelme", 40)
    keys = [one.key for one in store.fruit.find(FruitQuery(lot)).fruit]
    store.corrections.leave_out(keys[:2])
    store.corrections.name(keys[2:3], "quince")
    figures = read_figures(store, lot, clock.now_s)
    assert (figures.fruit, figures.left_out, figures.corrected) == (38, 2, 3)
    assert figures.volume_m3 is not None
    assert figures.volume_m3.value == pytest.approx(sum(made_fruit(number).volume_m3.value for number in range(2, 40)))
    assert figures.per_minute == pytest.approx(38 / 90)
    rows = kind_rows(figures)
    assert sum(int(row.fruit) for row in rows) == 38
    assert rows[-1].name == "Quince"


def test_a_lot_is_listed_with_its_sums(store: Store, clock: Clock) -> None:
    lot = run(store, clock, "1184", "Riquelme", 8)
    (line,) = store.lots.find(LotQuery()).lots
    entry = lot_entry(line, None, line.lot.started_s)
    assert (entry.key, entry.name, entry.who, entry.fruit, entry.state) == (
        lot,
        "1184",
        "Riquelme",
        "8",
        LotState.ENDED,
    )
    assert entry.litres == f"{line.volume_m3 * 1e3:.1f}\u2009l"


def test_kinds_keep_the_models_order_and_unknown_is_none_of_them() -> None:
    assert kinds_in_order(["pear", "apple"], ["unknown", "quince", "apple", "lime"]) == (
        "pear",
        "apple",
        "lime",
        "quince",
    )
    assert (kind_name("unknown"), kind_name("palta Hass")) == ("Unknown", "Palta Hass")


# fruit


@pytest.mark.parametrize(
    ("show", "kind", "which", "asked"),
    [
        (Show.COUNTED, "lemon", "counted", "lemon"), (Show.UNKNOWN, "lemon", "counted", "unknown"),
        (Show.CORRECTED, None, "corrected", None), (Show.LEFT_OUT, None, "left_out", None),
    ],
)  # fmt: skip
def test_what_the_table_shows_is_what_the_records_are_asked(
    show: Show, kind: str | None, which: str, asked: str
) -> None:
    query = Wanted(4, show, kind, Column.VOLUME, falling=True).query(3, 50)
    assert (query.lot, query.which, query.kind, query.order, query.falling) == (4, which, asked, "volume_m3", True)
    assert (query.first, query.count) == (150, 50)


def test_a_corrected_fruit_says_both_what_the_machine_and_what_a_person_said(store: Store, clock: Clock) -> None:
    lot = run(store, clock, "1184", "", 1)
    (fruit,) = store.fruit.find(FruitQuery(lot)).fruit
    assert correction_text(fruit) == person_text(fruit) == ""
    assert machine_text(fruit).startswith("The machine said Lemon, ")
    store.corrections.name([fruit.key], "quince", note="seen by hand")
    store.corrections.leave_out([fruit.key], who="Ana")
    story = store.fruit.story(fruit.key)
    assert cell_text(story.fruit, Column.KIND) == "Quince"
    assert correction_text(story.fruit) == "left out · machine: Lemon"
    assert person_text(story.fruit) == "A person named it Quince. A person left it out; it does not count."
    assert machine_text(story.fruit).startswith("The machine said Lemon, ")
    newest, first = said_lines(story.corrections)
    assert newest.endswith("left out (Ana)")
    assert first.endswith("Quince “seen by hand”")


def test_everything_measured_is_said_with_its_interval(store: Store, clock: Clock) -> None:
    lot = run(store, clock, "1184", "", 2)
    said = dict(facts(store.fruit.find(FruitQuery(lot)).fruit[1]))
    assert all("±" in said[name] for name in ("Volume", "uncorrected", "Mass", "Diameter", "Length", "Perimeter"))
    assert "by the paper" not in said, "what was not measured takes no line"


def test_every_correction_can_be_taken_back(store: Store, clock: Clock) -> None:
    lot = run(store, clock, "1184", "", 12)
    before = store.fruit.find(FruitQuery(lot)).fruit
    totals, undo = store.lots.totals(lot), Undo()
    for word in (
        Word(Deed.NAME, tuple(one.key for one in before[:6]), "quince"),
        Word(Deed.LEAVE_OUT, tuple(one.key for one in before[3:9])),
    ):
        now = [store.fruit.story(key).fruit for key in word.fruit]
        undo.add(undoing(word, now))
        word.say(store)
    assert store.lots.totals(lot) != totals
    while len(undo):
        for word in undo.take():
            word.say(store)
    after = store.fruit.find(FruitQuery(lot)).fruit
    assert after == before
    assert [one.fruit for one in store.lots.totals(lot)] == [one.fruit for one in totals]
    assert len(store.corrections.of(before[4].key)) == 4, "all that was said stays in the records"


def test_putting_back_what_counts_leaves_nothing_to_take_back(store: Store, clock: Clock) -> None:
    lot = run(store, clock, "1184", "", 1)
    assert undoing(Word(Deed.PUT_BACK, (1,)), store.fruit.find(FruitQuery(lot)).fruit) == []


@pytest.mark.usefixtures("qapp")
def test_crops_become_pictures_with_an_outline() -> None:
    views = view_pictures(crops(3))
    assert [view.sensor for view in views] == ["kinect_1", "kinect_2"]
    first = views[0]
    assert first.colour.pixelColor(30, 30).red() > 150
    assert first.depth.pixelColor(30, 30) != first.depth.pixelColor(3, 3)
    box = first.outline.boundingRect()
    assert (box.width(), box.height()) == pytest.approx((40, 40), abs=2)


@pytest.mark.usefixtures("qapp")
def test_damaged_crops_are_left_out() -> None:
    broken = [replace(crop, data=b"nothing" if crop.number == 0 else crop.data) for crop in crops(1)]
    assert [view.number for view in view_pictures(broken)] == [1]
    assert cv2.imdecode(np.frombuffer(b"nothing", np.uint8), cv2.IMREAD_UNCHANGED) is None


def _tilted_station() -> tuple[Station, Pose]:
    """Return a station whose sensor looks down at an angle, and the pose from the belt into its frame."""
    normal = np.array([0.3, -0.5, -0.8])
    plane = Plane(normal / np.linalg.norm(normal), 1.1)
    return Station("a", {"a": StationSensor("", Pose.exact(), Surface(plane))}), plane.frame().inverse()


def test_a_way_is_seen_from_above_along_the_motion() -> None:
    station, to_reference = _tilted_station()
    times = np.linspace(0.0, 2.0, 9)
    belt_m = np.column_stack([0.2 + 0.3 * times, 0.1 - 0.4 * times, np.full(9, 0.04)])
    covariance = to_reference.rotation @ np.diag([4e-6, 1e-6, 9e-4]) @ to_reference.rotation.T
    path = [
        PathPoint(float(time_s), to_reference.apply(place), covariance)
        for time_s, place in zip(times, belt_m, strict=True)
    ]
    seen = way(path, station)
    assert seen is not None
    assert (seen.length_m, seen.duration_s) == pytest.approx((1.0, 2.0))
    assert np.diff([one.x for one in seen.spreads]) == pytest.approx(np.full(8, 0.125))
    assert [one.y for one in seen.spreads] == pytest.approx(np.zeros(9), abs=1e-9)
    largest = max(one.major for one in seen.spreads)
    assert largest < 0.01, "how high it is is not seen from above"


def test_a_way_without_a_station_is_seen_in_its_own_plane() -> None:
    path = [PathPoint(at, np.array([0.1 * at, 0.2 * at, 1.0]), np.eye(3) * 1e-6) for at in range(4)]
    seen = way(path, None)
    assert seen is not None
    assert seen.length_m == pytest.approx(3 * np.hypot(0.1, 0.2))
    assert way(path[:1], None) is None


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("1184", "lot-1184"),
        ("12/3 Peñón: a?", "lot-12-3-Peñón-a"),
        ("///", "lot"),
        ("..", "lot"),
        ("漢" * 900, f"lot-{'漢' * 40}"),
    ],
)
def test_names_of_files_can_be_kept_anywhere(name: str, file: str) -> None:
    assert file_name("lot", name) == file


def test_a_plan_without_words_is_listed_all_the_same(store: Store) -> None:
    store.lots.start(LotPlan("x"))
    (line,) = store.lots.find(LotQuery()).lots
    assert lot_entry(line, None, 0.0).who == ""


@pytest.mark.parametrize(
    ("width", "height", "columns"), [(660, 150, 0), (700, 320, 2), (1300, 160, 4), (1300, 400, 4), (3200, 1500, 2)]
)
def test_as_many_spreads_are_shown_as_there_is_room_for(width: int, height: int, columns: int) -> None:
    assert columns_for(width, height) == columns
