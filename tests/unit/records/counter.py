"""A line that counts until it is killed: `python -m tests.unit.records.counter FOLDER`."""

from __future__ import annotations

import sys
from itertools import count
from pathlib import Path

from fruitgui.records.lot import LotPlan
from fruitgui.records.store import open_store
from tests.unit.station.fruit_made import made_crops, made_fruit


def main(folder: Path) -> None:
    """Commit fruit after fruit, and print each one's number once it is counted."""
    store = open_store(folder)
    lot = store.lots.open_lot() or store.lots.start(LotPlan("killed"))
    for number in count(1):
        counted = store.commit(lot.key, made_fruit(number % 50), made_crops(number % 50))
        sys.stdout.write(f"{counted.number}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
