"""What the Lots screen asks: lists, totals, pages, distributions, corrections."""

from __future__ import annotations

import csv
import json
import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sqlalchemy import Engine, event

from fruitgui.errors import CancelledByUserError, InputError
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.measurement.sums import USUAL_SHARE
from fruitgui.records.fruit_search import FruitQuery, Which
from fruitgui.records.lot import Lot, LotPlan
from fruitgui.records.lot_csv import HEADER, write_lot
from fruitgui.records.lot_report import report_lot
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.store import Store, open_store
from fruitgui.station.live.blind import Blind
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import station_value
from tests.unit.records.conftest import Clock
from tests.unit.station.fruit_made import KINDS, made_crops, made_fruit


def _fill(store: Store, lot: Lot, numbers: range) -> None:
    store.counting.commit_batch(lot.key, [(made_fruit(number), ()) for number in numbers])


def test_lots_are_found_by_word_and_date_the_newest_first_with_their_totals(store: Store, clock: Clock) -> None:
    for name, grower in (("1184", "Fundo El Peñón"), ("1185", "Agrícola_100%"), ("1186", "Fundo Norte")):
        clock.now_s += 86_400
        lot = store.lots.start(LotPlan(name, grower))
        _fill(store, lot, range(int(name) - 1180))
        store.lots.end(lot.key)
    everything = store.lots.find(LotQuery())
    assert [line.lot.name for line in everything.lots] == ["1186", "1185", "1184"]
    assert [line.fruit for line in everything.lots] == [6, 5, 4]
    assert everything.lots[0].volume_m3 == pytest.approx(sum(made_fruit(n).volume_m3.value for n in range(6)))
    page = store.lots.find(LotQuery(words="fundo", first=1, count=1))
    assert ([line.lot.name for line in page.lots], page.found) == (["1184"], 2)
    assert store.lots.find(LotQuery(words="fundo 1186")).found == 1
    for words in ("penon", "PEÑÓN", "Fundo peñon"):
        assert [line.lot.name for line in store.lots.find(LotQuery(words=words)).lots] == ["1184"]
    assert [line.lot.name for line in store.lots.find(LotQuery(words="_100%")).lots] == ["1185"]
    assert store.lots.find(LotQuery(from_s=clock.now_s - 90_000, to_s=clock.now_s - 1)).found == 1


def _std_of_sum(stds: Sequence[float], shared: Sequence[float]) -> float:
    own2 = sum(std**2 - part**2 for std, part in zip(stds, shared, strict=True))
    return math.sqrt(own2 + sum(shared) ** 2)


def test_the_total_of_a_kind_adds_values_and_what_each_errs_by_alone_and_together(store: Store, lot: Lot) -> None:
    fruit = [made_fruit(number, "lemon") for number in range(40)]
    fruit[:30] = [replace(one, volume_shared_m3=0.3 * one.volume_m3.std) for one in fruit[:30]]
    for one in fruit:
        store.commit(lot.key, one, ())
    (total,) = store.lots.totals(lot.key)
    volumes = np.array([one.volume_m3.value for one in fruit])
    stds = [one.volume_m3.std for one in fruit]
    shared = [(0.3 if at < 30 else USUAL_SHARE) * std for at, std in enumerate(stds)]
    masses = [one.mass_kg for one in fruit if one.mass_kg is not None]
    assert (total.kind, total.fruit, total.measured, total.weighed) == ("lemon", 40, 40, len(masses))
    assert total.volume_m3.value == pytest.approx(volumes.sum())
    assert total.volume_m3.std == pytest.approx(_std_of_sum(stds, shared))
    assert total.mean_volume_m3 is not None
    assert total.mean_volume_m3.std == pytest.approx(total.volume_m3.std / 40)
    assert total.volume_spread_m3 == pytest.approx(volumes.std(ddof=1))
    assert total.mean_volume_m3 is not None
    assert total.mean_volume_m3.value == pytest.approx(volumes.mean())
    assert total.mass_kg.value == pytest.approx(sum(one.value for one in masses))


def test_a_page_of_fruit_is_sorted_and_filtered(store: Store, lot: Lot) -> None:
    _fill(store, lot, range(60))
    page = store.fruit.find(FruitQuery(lot.key, kind=KINDS[1], order="volume_m3", falling=True, first=2, count=5))
    wanted = sorted((made_fruit(n).volume_m3.value for n in range(60) if n % 4 == 1), reverse=True)
    assert page.found == 15
    assert [one.volume_m3.value for one in page.fruit if one.volume_m3] == wanted[2:7]
    heaviest = store.fruit.find(FruitQuery(lot.key, order="mass_kg", count=60)).fruit
    assert [one.mass_kg is None for one in heaviest] == [False] * 40 + [True] * 20, "what was not measured comes last"


def test_a_fruit_comes_back_with_its_path_and_crops(store: Store, lot: Lot) -> None:
    fruit = made_fruit(5)
    counted = store.commit(lot.key, fruit, made_crops(5))
    story = store.fruit.story(counted.key)
    assert story.fruit.volume_m3 == fruit.volume_m3
    assert story.fruit.mass_kg == fruit.mass_kg
    assert story.fruit.fitted_volume_m3 == fruit.size.volume_m3
    assert (story.fruit.first_seen_s, story.fruit.last_seen_s) == (fruit.first_seen_s, fruit.last_seen_s)
    assert [point.time_s for point in story.path] == [point.time_s for point in fruit.path]
    for ours, theirs in zip(story.path, fruit.path, strict=True):
        np.testing.assert_allclose(ours.position_m, theirs.position_m, rtol=1e-6)
        np.testing.assert_allclose(ours.covariance_m2, theirs.covariance_m2, rtol=1e-6)
    assert len(story.crops) == 2
    assert story.corrections == ()


def test_a_corrected_fruit_keeps_what_the_machine_said(store: Store, lot: Lot) -> None:
    key = store.commit(lot.key, made_fruit(0), ()).key
    store.corrections.name([key], "quince", who="Ana", note="seen by hand")
    story = store.fruit.story(key)
    assert (story.fruit.kind, story.fruit.machine_kind, story.fruit.corrected) == ("quince", "lemon", True)
    assert [(one.kind, one.counted, one.who, one.note) for one in story.corrections] == [
        ("quince", None, "Ana", "seen by hand")
    ]
    store.corrections.leave_out([key])
    assert store.lots.totals(lot.key) == ()
    store.corrections.put_back([key])
    store.corrections.name([key], "lemon")
    assert not store.fruit.story(key).fruit.corrected
    assert [total.kind for total in store.lots.totals(lot.key)] == ["lemon"]


def test_a_fruit_that_the_machine_missed_is_added_without_measurements(store: Store, lot: Lot) -> None:
    _fill(store, lot, range(3))
    added = store.fruit.story(store.corrections.add(lot.key, "lemon", "Ana", "fell past")).fruit
    assert (added.number, added.machine_kind, added.volume_m3, added.corrected) == (4, None, None, True)
    lemons = next(total for total in store.lots.totals(lot.key) if total.kind == "lemon")
    assert (lemons.fruit, lemons.measured) == (2, 1)
    assert store.commit(lot.key, made_fruit(9), ()).number == 5


@pytest.mark.parametrize("kind", ["", "  ", "x" * 65, "two\nlines"])
def test_a_kind_is_a_printable_word(store: Store, lot: Lot, kind: str) -> None:
    key = store.commit(lot.key, made_fruit(0), ()).key
    with pytest.raises(InputError):
        store.corrections.name([key], kind)
    assert store.corrections.of(key) == ()


Step = st.tuples(st.sampled_from(["count", "name", "leave_out", "put_back", "add"]), st.integers(0, 30))


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(Step, min_size=1, max_size=25))
def test_totals_always_equal_the_fruit_that_they_sum_up(store: Store, steps: list[tuple[str, int]]) -> None:
    lot = store.lots.start(LotPlan("any"))
    keys: list[int] = []
    for what, number in steps:
        chosen = [keys[number % len(keys)]] if keys else []
        if what == "count":
            keys.append(store.commit(lot.key, made_fruit(number), ()).key)
        elif what == "add":
            keys.append(store.corrections.add(lot.key, KINDS[number % 4]))
        elif what == "name":
            store.corrections.name(chosen, KINDS[number % 4])
        elif what == "leave_out":
            store.corrections.leave_out(chosen)
        else:
            store.corrections.put_back(chosen)
    store.lots.end(lot.key)
    there = [one for one in store.fruit.walk(lot.key) if one.counted]
    totals = store.lots.totals(lot.key)
    assert {one.kind: one.fruit for one in totals} == Counter(one.kind for one in there)
    for total in totals:
        volumes = [one.volume_m3 for one in there if one.kind == total.kind and one.volume_m3 is not None]
        assert total.measured == len(volumes)
        assert total.volume_m3.value == pytest.approx(sum(one.value for one in volumes), rel=1e-12)
        assert total.volume_m3.std == pytest.approx(
            _std_of_sum([one.std for one in volumes], [USUAL_SHARE * one.std for one in volumes]), rel=1e-9
        )


@pytest.mark.parametrize("bins", [1, 10, 40])
def test_a_distribution_counts_every_measured_fruit_in_round_bins(store: Store, lot: Lot, bins: int) -> None:
    _fill(store, lot, range(200))
    spread = store.fruit.distribution(lot.key, "volume_m3", bins)
    volumes = np.array([made_fruit(n).volume_m3.value for n in range(200)])
    np.testing.assert_array_equal(sum(spread.counts.values()), np.histogram(volumes, spread.edges)[0])
    assert spread.counts[KINDS[0]].sum() == 50
    assert len(spread.edges) - 1 <= bins + 1
    assert f"{spread.edges[1] - spread.edges[0]:.0e}"[0] in "125"


def test_a_distribution_of_equal_or_of_no_fruit(store: Store, lot: Lot) -> None:
    assert len(store.fruit.distribution(lot.key, "mass_kg").edges) == 0
    store.counting.commit_batch(lot.key, [(made_fruit(1), ())] * 3)
    spread = store.fruit.distribution(lot.key, "volume_m3")
    assert sum(spread.counts.values()).tolist() == [3]


def test_a_lot_as_csv_has_units_and_what_was_left_out(store: Store, lot: Lot, tmp_path: Path) -> None:
    _fill(store, lot, range(5))
    keys = [one.key for one in store.fruit.walk(lot.key)]
    store.corrections.leave_out(keys[:1])
    store.corrections.name(keys[1:2], "quince")
    store.corrections.add(lot.key, "lemon")
    path = tmp_path / "lot.csv"
    assert write_lot(store, lot.key, path) == 6
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert tuple(rows[0]) == HEADER
    assert [row["counted"] for row in rows] == ["0", "1", "1", "1", "1", "1"]
    assert (rows[1]["kind"], rows[1]["machine_kind"]) == ("quince", KINDS[1])
    assert float(rows[2]["volume_ml"]) == pytest.approx(made_fruit(2).volume_m3.value * 1e6, rel=1e-5)
    assert rows[2]["counted_at_utc"] == "2027-01-15T08:00:00.000+00:00"
    assert rows[5]["volume_ml"] == rows[5]["machine_kind"] == ""


@pytest.mark.parametrize("kind", ["=cmd|' /C calc'!A0", "+1", "-1", "@SUM(A1)"])
def test_a_table_of_a_lot_holds_no_formula(store: Store, tmp_path: Path, kind: str) -> None:
    lot = store.lots.start(LotPlan(kind, recipe=kind))
    store.commit(lot.key, replace(made_fruit(1), kind=kind), ())
    path = tmp_path / "lot.csv"
    write_lot(store, lot.key, path)
    (row,) = csv.DictReader(path.read_text(encoding="utf-8").splitlines())
    assert {row[name] for name in ("lot", "kind", "machine_kind", "recipe")} == {f"'{kind}"}
    assert not any(cell.startswith(("=", "+", "@")) for cell in row.values())


def test_a_lot_as_csv_says_which_sensors_were_away_for_which_fruit_and_for_how_long_fruit_may_be_missing(
    store: Store, lot: Lot, clock: Clock, tmp_path: Path
) -> None:
    def one_passes(number: int) -> None:
        clock.now_s += 60.0
        _fill(store, lot, range(number, number + 1))

    one_passes(0)
    clock.now_s += 60.0
    store.spells.note(lot.key, Blind(("kinect_2",), ((0.4, 0.6),), 0.6, 0.3))
    one_passes(1)
    clock.now_s += 10.0
    store.spells.note(lot.key, Blind(("kinect_3",), None, None, 0.2), "sparse")
    clock.now_s += 20.0
    store.spells.note(lot.key, Blind(("kinect_1",), (), 0.6, 0.0))
    one_passes(2)
    store.spells.note(lot.key, None, "sparse")
    clock.now_s += 0.5 * _in_view_s(3)
    store.spells.note(lot.key, None)
    clock.now_s += 0.25 * _in_view_s(3)
    _fill(store, lot, range(3, 4))
    one_passes(4)
    store.corrections.add(lot.key, "lemon")
    clock.now_s += 1.0
    store.spells.note(lot.key, Blind(("kinect_1", "kinect_2"), None, None, 1.0))
    clock.now_s += 5.0
    path = tmp_path / "lot.csv"
    assert write_lot(store, lot.key, path, now_s=clock.now_s) == 6
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert [row["sensors_away"] for row in rows] == ["", "kinect_2", "kinect_1", "kinect_1", "", ""]
    assert [row["sensors_sparse"] for row in rows] == ["", "", "kinect_3", "kinect_3", "", ""]
    assert {row["lot_unseen_s"] for row in rows} == {"155"}, "what two had in common counts once"


def _in_view_s(number: int) -> float:
    fruit = made_fruit(number)
    return fruit.last_seen_s - fruit.first_seen_s


def test_an_export_that_was_stopped_leaves_no_file(store: Store, lot: Lot, tmp_path: Path) -> None:
    store.counting.commit_batch(lot.key, [(made_fruit(0, views=1), ())] * 2500)
    before = set(tmp_path.iterdir())
    with pytest.raises(CancelledByUserError):
        write_lot(store, lot.key, tmp_path / "lot.csv", cancelled=lambda: True)
    assert set(tmp_path.iterdir()) == before


def test_a_report_holds_what_one_would_hand_to_a_grower(store: Store, lot: Lot, clock: Clock) -> None:
    _fill(store, lot, range(30))
    clock.now_s += 600
    keys = [one.key for one in store.fruit.walk(lot.key)]
    store.corrections.leave_out(keys[:2])
    store.corrections.name(keys[2:5], "quince")
    report = report_lot(store, lot.key, clock.now_s)
    assert (report.fruit, report.left_out, report.corrected, report.ran_s) == (28, 2, 5, 600)
    assert report.volume_m3.value == pytest.approx(sum(one.volume_m3.value for one in report.kinds))
    parts = [one.volume_m3.std for one in report.kinds]
    assert math.hypot(*parts) < report.volume_m3.std <= sum(parts), "what kinds share is not averaged out"
    assert sum(counts.sum() for counts in report.spread["mass_kg"].counts.values()) == report.weighed


def test_reading_goes_on_while_another_thread_writes(tmp_path: Path) -> None:
    with open_store(tmp_path) as store:
        lot = store.lots.start(LotPlan("both"))
        _fill(store, lot, range(10))
        walk = store.fruit.walk(lot.key)
        next(walk)
        store.commit(lot.key, made_fruit(11), ())
        assert len(list(walk)) == 9, "a walk sees the lot as it was when it began"


def _plan(store: Store, ask: Callable[[], object]) -> str:
    """Return how the database goes about all that is asked of it."""
    asked: list[tuple[str, Any]] = []

    def listen(_connection: object, _cursor: object, statement: str, parameters: object, *_: object) -> None:
        if statement.startswith("SELECT"):
            asked.append((statement, parameters))

    event.listen(Engine, "before_cursor_execute", listen)
    try:
        ask()
    finally:
        event.remove(Engine, "before_cursor_execute", listen)
    with store._records.connected() as connection:
        plans = [connection.exec_driver_sql(f"EXPLAIN QUERY PLAN {sql}", values).all() for sql, values in asked]
    return "\n".join(str(row[3]) for plan in plans for row in plan)


@pytest.mark.parametrize("which", ["corrected", "left_out"])
def test_what_people_corrected_is_found_by_its_index(store: Store, which: Which) -> None:
    plan = _plan(store, lambda: store.fruit.find(FruitQuery(1, which=which)))
    assert plan.count("fruit_corrected") == 2
    assert "SCAN" not in plan


def test_volumes_are_spread_without_reading_a_row(store: Store, lot: Lot) -> None:
    _fill(store, lot, range(3))
    plan = _plan(store, lambda: store.fruit.distribution(lot.key, "volume_m3"))
    assert plan.count("COVERING INDEX fruit_kind") == 2


def test_the_largest_of_a_kind_are_read_off_an_index(store: Store) -> None:
    plan = _plan(store, lambda: store.fruit.find(FruitQuery(1, kind="lemon", order="volume_m3", falling=True)))
    assert "fruit_kind (kind=? AND lot_id=? AND counted=?)" in plan


def test_a_page_of_lots_goes_through_no_fruit(store: Store, lot: Lot) -> None:
    _fill(store, lot, range(3))
    assert "fruit" not in _plan(store, lambda: store.lots.find(LotQuery()))


def station_text(serials: dict[str, str]) -> str:
    """Return a station's file whose sensors are these devices."""
    surface = Surface(
        Plane(np.array([0.0, 0.0, -1.0]), 1.0), np.array([[-0.3, -0.3, 1.0], [0.3, -0.3, 1.0], [0.0, 0.3, 1.0]])
    )
    sensors = {name: StationSensor(serial, Pose.exact(), surface) for name, serial in serials.items()}
    return json.dumps(station_value(Station(next(iter(sensors)), sensors)))


@pytest.mark.parametrize(
    ("text", "sensors"),
    [
        (station_text({"left": "A22595U34223", "right": ""}), "left=A22595U34223 right"),
        ('{"schema": 1}', ""),
        (None, ""),
    ],
)
def test_a_lot_as_csv_tells_which_device_each_sensor_was(
    store: Store, tmp_path: Path, text: str | None, sensors: str
) -> None:
    lot = store.lots.start(LotPlan("1", station_text=text))
    _fill(store, lot, range(2))
    path = tmp_path / "lot.csv"
    write_lot(store, lot.key, path)
    rows = csv.DictReader(path.read_text(encoding="utf-8").splitlines())
    assert [row["lot_sensors"] for row in rows] == 2 * [sensors]
