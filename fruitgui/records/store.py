"""The store of one workspace, opened by one owner."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType

from fruitgui.errors import WorldError
from fruitgui.records.condition import set_aside
from fruitgui.records.correcting import Corrections
from fruitgui.records.counting import Counting
from fruitgui.records.crops import Crops
from fruitgui.records.fruit_search import CountedFruits
from fruitgui.records.lots import Lots
from fruitgui.records.migrating import PICTURES, RECORDS, bring_up_to_date, version_of
from fruitgui.records.models import Models
from fruitgui.records.restore import finish_restore
from fruitgui.records.settings_history import SettingsHistory
from fruitgui.records.spells import Spells
from fruitgui.records.steady_clock import SteadyClock
from fruitgui.records.teaching import Teaching
from fruitgui.records.told import damaged
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import CountedFruit, Crop


class Store:
    """All that is kept of a line. Any thread may use it; it is itself a `FruitSink`.

    Made by `open_store`; the one that opened it closes it. Everything in it may raise `WorldError`: disk full,
    read-only, locked by another program, damaged.

    Attributes:
        folder: the workspace.
        lots: started, paused, ended.
        spells: what of the belt was not seen while a lot ran.
        counting: fruit from the line.
        fruit: those that were counted, for reading.
        corrections: what people say of them.
        crops: their pictures.
        teaching: taught fruit, and those that wait to be named.
        models: which there are, and which is in use.
        settings: which value each had, and since when.
        now_s: the time of day by which all of it is dated.
    """

    def __init__(self, folder: Path, clock_s: Callable[[], float] | None = None) -> None:
        self.folder = folder
        self.now_s = now_s = SteadyClock() if clock_s is None else SteadyClock(clock_s, clock_s)
        finish_restore(folder)
        _refuse_emptied(folder)
        if version_of(folder / RECORDS.file) is None and (folder / PICTURES.file).exists():
            set_aside(folder / PICTURES.file)  # of other records: new fruit would be shown with old pictures
        self._records = bring_up_to_date(folder / RECORDS.file, RECORDS)
        try:
            self._pictures = bring_up_to_date(folder / PICTURES.file, PICTURES)
        except WorldError:
            self._records.close()
            raise
        self.crops = Crops(self._pictures, now_s)
        self.lots = Lots(self._records, now_s)
        self.spells = Spells(self._records, now_s)
        self.counting = Counting(self._records, self.crops, now_s)
        self.fruit = CountedFruits(self._records, self.crops)
        self.corrections = Corrections(self._records, now_s)
        self.teaching = Teaching(self._records, self.crops, now_s)
        self.models = Models(self._records, now_s)
        self.settings = SettingsHistory(self._records, now_s)

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:
        """Keep one fruit, see `FruitSink.commit`."""
        return self.counting.commit(lot, fruit, crops)

    def close(self) -> None:
        """Let go of the files; all is on the disk already."""
        self._records.close()
        self._pictures.close()

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _refuse_emptied(folder: Path) -> None:
    """Raise `store_damaged` where the records' file has nothing in it though it had: their pictures are there."""
    records = folder / RECORDS.file
    if records.exists() and records.stat().st_size == 0 and version_of(folder / PICTURES.file) is not None:
        raise damaged(records, "it is empty, and the pictures of its fruit are there")


def open_store(folder: Path, clock_s: Callable[[], float] | None = None) -> Store:
    """Open the store in a folder, made where there is none; older files are brought up to date, copies set aside.

    Args:
        folder: the workspace.
        clock_s: tells the time of day, Unix seconds, evenly; the computer's where none is given.

    Raises:
        WorldError: `store_newer`, `store_damaged`, `store_read_only`, `store_locked` or `disk_full`; nothing was
            changed.
    """
    return Store(folder, clock_s)
