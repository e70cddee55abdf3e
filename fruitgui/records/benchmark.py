"""`python -m fruitgui.records.benchmark`: how long the Lots screen waits for a store with a million fruit.

Filled in bulk, in a temporary folder, with lots of even length and one that is fifty times as long. Each query is asked
as the screen asks it, through the same calls; figures are medians of a few, after one that warms up. The clock's say as
much about what else the machine does as about the store; the processor's do not.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from sqlalchemy import insert, text

from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.records.database import Database
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot_report import report_lot
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.migrating import PICTURES, RECORDS
from fruitgui.records.packing import pack_path
from fruitgui.records.picture_tables import CropRow
from fruitgui.records.store import Store, open_store
from fruitgui.records.tables import FruitRow, LotRow, PathRow
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import Crop
from fruitgui.tracking.track import PathPoint

FRUIT = 1_000_000
LOTS = 2_000
LONG_LOT = 100_000
"""Fruit of the one long lot: a day of a fast line."""

KINDS = ("lemon", "red apple", "green apple", "avocado, Chilean", "unknown")
CROP_BYTES = 1_500
VIEWS = 24
AT_ONCE = 5_000
ASKED = 5
STARTED_S = 1.7e9


SUMS = text(
    "INSERT INTO total SELECT lot_id, kind, count(*), count(volume_m3), total(volume_m3), "
    "total(volume_std_m3 * volume_std_m3), total(volume_m3 * volume_m3), count(mass_kg), total(mass_kg), "
    "total(mass_std_kg * mass_std_kg), total(mass_kg * mass_kg) FROM fruit WHERE lot_id = :lot GROUP BY kind"
)


def main() -> int:
    """Fill a store and print how long each question takes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fruit", type=int, default=FRUIT)
    parser.add_argument("--lots", type=int, default=LOTS)
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="fruitgui-benchmark-") as name:
        for line in figures(Path(name), wanted.fruit, wanted.lots):
            sys.stdout.write(line + "\n")
            sys.stdout.flush()
    return 0


def figures(folder: Path, fruit: int, lots: int) -> Iterator[str]:
    """Fill a store with so many fruit in so many lots; give one line for each figure."""
    began_s = time.perf_counter()
    fill(folder, fruit, lots)
    sizes_mb = {path.name: path.stat().st_size / 1e6 for path in sorted(folder.glob("*.sqlite"))}
    took_s = time.perf_counter() - began_s
    yield f"filled with {fruit} fruit in {lots} lots in {took_s:.0f} s: " + ", ".join(
        f"{name} {size_mb:.0f} MB" for name, size_mb in sizes_mb.items()
    )
    began_s = time.perf_counter()
    with open_store(folder) as store:
        yield f"open: {(time.perf_counter() - began_s) * 1e3:.0f} ms"
        long = store.lots.find(LotQuery(words="long")).lots[0].lot.key
        usual = store.lots.find(LotQuery(count=1, first=lots // 2)).lots[0].lot.key
        for what, ask in questions(store, usual, long, lots):
            yield f"{what}: {_times(ask)}"
        yield f"commit of one fruit with two crops: {_times(_commit(store, usual), 50)}"


def questions(store: Store, usual: int, long: int, lots: int) -> Iterator[tuple[str, Callable[[], object]]]:
    """Give what the Lots screen asks."""
    yield "first page of lots with totals", lambda: store.lots.find(LotQuery())
    yield "last page of lots with totals", lambda: store.lots.find(LotQuery(first=lots - 50))
    yield "lots by word", lambda: store.lots.find(LotQuery(words="grower 7"))
    yield "lots by date", lambda: store.lots.find(LotQuery(from_s=STARTED_S + 1e6, to_s=STARTED_S + 2e6))
    for name, lot in (("usual lot", usual), ("long lot", long)):
        yield from _of_a_lot(store, name, lot)


def _of_a_lot(store: Store, name: str, lot: int) -> Iterator[tuple[str, Callable[[], object]]]:
    some = store.fruit.find(FruitQuery(lot, first=3, count=1)).fruit[0].key
    last = store.fruit.find(FruitQuery(lot, count=0)).found - 100
    yield f"{name}: totals", lambda: store.lots.totals(lot)
    yield f"{name}: volumes' distribution", lambda: store.fruit.distribution(lot, "volume_m3")
    yield f"{name}: first page", lambda: store.fruit.find(FruitQuery(lot))
    yield f"{name}: last page", lambda: store.fruit.find(FruitQuery(lot, first=last))
    largest = FruitQuery(lot, KINDS[0], order="volume_m3", falling=True)
    yield f"{name}: largest of one kind", lambda: store.fruit.find(largest)
    yield f"{name}: all by mass, last page", lambda: store.fruit.find(FruitQuery(lot, order="mass_kg", first=last))
    yield f"{name}: corrected", lambda: store.fruit.find(FruitQuery(lot, which="corrected"))
    yield f"{name}: one fruit with path and crops", lambda: store.fruit.story(some)
    yield f"{name}: correct one fruit", _correct(store, some)
    yield f"{name}: report", lambda: report_lot(store, lot, STARTED_S)


def _correct(store: Store, fruit: int) -> Callable[[], object]:
    kinds = iter(range(10**9))
    return lambda: store.corrections.name([fruit], KINDS[next(kinds) % len(KINDS)])


def _commit(store: Store, lot: int) -> Callable[[], object]:
    path = _path(np.random.default_rng(1), 0.0)
    some = Quantity(1e-4, 1e-6)
    fruit = Fruit(1, "lemon", 0.9, Size(some, some, some, some, 0.7), some, some, None, len(path), path)
    crops = [Crop(at, "colour", f"kinect_{at}", 0.0, 0, 0, "jpeg", bytes(CROP_BYTES)) for at in range(2)]
    return lambda: store.commit(lot, fruit, crops)


def _times(ask: Callable[[], object], times: int = ASKED) -> str:
    """Return the median times of asking: by the clock, and of the processor."""
    ask()
    wall_s, processor_s = [], []
    for _ in range(times):
        began_s, began_processor_s = time.perf_counter(), time.process_time()
        ask()
        wall_s.append(time.perf_counter() - began_s)
        processor_s.append(time.process_time() - began_processor_s)
    return f"{np.median(wall_s) * 1e3:.1f} ms ({np.median(processor_s) * 1e3:.1f} ms of the processor)"


def fill(folder: Path, fruit: int, lots: int) -> None:
    """Make a store and fill it by the thousand, past its front door."""
    open_store(folder).close()
    records, pictures = Database(folder / RECORDS.file), Database(folder / PICTURES.file)
    chance = np.random.default_rng(1)
    long = min(LONG_LOT, fruit // 2)
    usual = (fruit - long) // (lots - 1)
    blobs = _Blobs(
        [pack_path(_path(chance, STARTED_S)) for _ in range(100)], [chance.bytes(CROP_BYTES) for _ in range(100)]
    )
    first = 1
    for at in range(lots):
        count = long if at == lots // 3 else usual
        with records.writing() as session:
            session.add(_lot(at, "long lot" if count == long else "lot"))
            for number in range(1, count + 1, AT_ONCE):
                some = range(number, min(number + AT_ONCE, count + 1))
                session.execute(insert(FruitRow), _fruit(chance, at + 1, some, first))
                session.execute(insert(PathRow), blobs.paths(some, first))
                with pictures.writing() as other:
                    other.execute(insert(CropRow), blobs.crops(some, first))
                first += len(some)
            session.execute(SUMS, {"lot": at + 1})
    records.close()
    pictures.close()


def _lot(at: int, name: str) -> LotRow:
    began_s = STARTED_S + 7200.0 * at
    return LotRow(
        name=f"{name} {at}", grower=f"grower {at % 97}", recipe="", note="",
        reference_sensor="kinect_1", size_bands={}, outlets=[], started_s=began_s, ended_s=began_s + 3600.0,
    )  # fmt: skip


def _fruit(chance: np.random.Generator, lot: int, numbers: range, first: int) -> list[dict[str, object]]:
    volumes_m3 = chance.lognormal(np.log(150e-6), 0.4, len(numbers))
    kinds = chance.choice(len(KINDS), len(numbers), p=(0.4, 0.3, 0.2, 0.08, 0.02))
    return [
        _columns(lot, number, first + at, KINDS[kinds[at]], float(volumes_m3[at])) for at, number in enumerate(numbers)
    ]


def _columns(lot: int, number: int, key: int, kind: str, volume_m3: float) -> dict[str, object]:
    length_m = (6 * volume_m3 / np.pi) ** (1 / 3)
    seen_s = STARTED_S + 0.1 * number
    return {
        "id": key, "lot_id": lot, "number": number, "line_number": number, "counted_s": seen_s, "machine_kind": kind,
        "kind_probability": 0.9, "kind": kind, "counted": True, "outlet": None,
        "volume_m3": volume_m3, "volume_std_m3": 0.03 * volume_m3,
        "fitted_volume_m3": volume_m3, "fitted_volume_std_m3": 0.03 * volume_m3, "paper_volume_m3": None,
        "mass_kg": 950 * volume_m3, "mass_std_kg": 30 * volume_m3, "length_m": 1.1 * length_m, "length_std_m": 1e-3,
        "diameter_m": length_m, "diameter_std_m": 1e-3, "perimeter_m": 3.3 * length_m, "perimeter_std_m": 2e-3,
        "coverage": 0.7, "spoilt": 0.0, "views": VIEWS, "first_seen_s": seen_s, "last_seen_s": seen_s + 1.0,
    }  # fmt: skip


def _path(chance: np.random.Generator, began_s: float) -> tuple[PathPoint, ...]:
    return tuple(
        PathPoint(began_s + at / 30, chance.normal(size=3), np.diag(chance.uniform(1e-6, 1e-5, 3)))
        for at in range(VIEWS)
    )


@dataclass(frozen=True, slots=True)
class _Blobs:
    """Paths and pictures, drawn once and used again and again."""

    path: list[bytes]
    picture: list[bytes]

    def paths(self, numbers: range, first: int) -> list[dict[str, object]]:
        return [
            {"fruit_id": first + at, "points": self.path[number % len(self.path)]} for at, number in enumerate(numbers)
        ]

    def crops(self, numbers: range, first: int) -> list[dict[str, object]]:
        return [
            {
                "owner": "fruit", "owner_id": first + at, "number": 0, "content": "colour", "sensor": "kinect_1",
                "time_s": 0.0, "left_px": 0, "top_px": 0, "coding": "jpeg", "kept_s": STARTED_S,
                "data": self.picture[number % len(self.picture)],
            }
            for at, number in enumerate(numbers)
        ]  # fmt: skip


if __name__ == "__main__":
    sys.exit(main())
