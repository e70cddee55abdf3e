"""What the screen asks of the store and changes in it, beside the window; no widgets."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from fruitgui.errors import InputError
from fruitgui.gui.kind_words import kinds_in_order
from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.lots.figures import LotFigures, read_figures
from fruitgui.gui.steps.lots.fruit_model import thumbnails
from fruitgui.gui.steps.lots.fruit_pictures import ShownFruit, way
from fruitgui.gui.steps.lots.fruit_rows import Wanted
from fruitgui.gui.steps.lots.hand import Undo, Word, undoing
from fruitgui.gui.steps.lots.words import SPREAD
from fruitgui.gui.view_pictures import view_pictures
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.records.fruit_search import FruitPage
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.store import Store
from fruitgui.station.kind_names import known_kind
from fruitgui.station.station import Station
from fruitgui.station.station_file import station_of

BINS = 40


@dataclass(frozen=True, slots=True)
class ReadLot:
    """A lot with its sums, and the kinds that its fruit can be, in order."""

    figures: LotFigures
    kinds: tuple[str, ...]


class Desk(QObject):
    """Asks and changes; every answer is a signal on the window's thread.

    Attributes:
        lots_read: number of a page, `LotPage`.
        lot_read: `ReadLot`. spread_read: key of its lot, `Distribution`.
        fruit_read: number of a page, `FruitPage`, `Wanted`. pictures_read: by key of fruit.
        fruit_shown: `ShownFruit`, its row, how many rows there are.
        corrected: a `Word` that was said, or taken back.
        failed: a `FruitguiError`.
        known: kinds that the model knows, in its order.
        queries: beside the window.
    """

    lots_read = Signal(int, object)
    lot_read = Signal(object)
    spread_read = Signal(int, object)
    fruit_read = Signal(int, object, object)
    pictures_read = Signal(object)
    fruit_shown = Signal(object, int, int)
    corrected = Signal(object)
    failed = Signal(object)

    def __init__(self, store: Store, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._store = store
        self._station: tuple[int, Station | None] | None = None
        self._undo: defaultdict[int | None, Undo] = defaultdict(Undo)
        self.known: Sequence[str] = ()
        self.queries = Queries(self)
        self.queries.failed.connect(self.failed)

    def can_undo(self, lot: int | None) -> bool:
        """Tell whether something was said of a lot's fruit that can be taken back."""
        return len(self._undo[lot]) > 0

    def ask_lots(self, query: LotQuery, page: int) -> None:
        """Ask for a page of lots."""
        self.queries.ask("lots", lambda: self._store.lots.find(query), lambda found: self.lots_read.emit(page, found))

    def ask_lot(self, lot: int) -> None:
        """Ask for a lot's sums."""
        known = self.known

        def read() -> ReadLot:
            figures = read_figures(self._store, lot, self._store.now_s())
            there = kinds_in_order(known, (one.kind for one in figures.kinds))
            taught = (known_kind(one.kind, there) for one in self._store.teaching.counts())
            return ReadLot(figures, kinds_in_order(known, [*there, *taught]))

        self.queries.ask("lot", read, self.lot_read.emit)

    def ask_spreads(self, lot: int) -> None:
        """Ask how a lot's measures are spread, one after the other."""
        for measured in SPREAD:
            read = partial(self._store.fruit.distribution, lot, measured, BINS)
            self.queries.ask_later(f"spread of {measured}", read, partial(self.spread_read.emit, lot))

    def ask_fruit(self, wanted: Wanted, page: int, size: int) -> None:
        """Ask for a page of fruit, and then for their pictures."""

        def answer(found: FruitPage) -> None:
            keys = [one.key for one in found.fruit]
            self.queries.ask(
                "pictures", lambda: thumbnails(self._store.crops.first("fruit", keys)), self.pictures_read.emit
            )
            self.fruit_read.emit(page, found, wanted)

        self.queries.ask("fruit", lambda: self._store.fruit.find(wanted.query(page, size)), answer)

    def open_row(self, wanted: Wanted, row: int) -> None:
        """Ask for all of the fruit at a row."""

        def read() -> tuple[ShownFruit | None, int]:
            found = self._store.fruit.find(wanted.query(row, 1))
            return (self._read_fruit(found.fruit[0].key) if found.fruit else None), found.found

        self.queries.ask("story", read, lambda answer: self.fruit_shown.emit(answer[0], row, answer[1]))

    def open_again(self, wanted: Wanted, key: int, row: int) -> None:
        """Ask again for all of a fruit, wherever it is in the list by now."""

        def read() -> tuple[ShownFruit, int]:
            return self._read_fruit(key), self._store.fruit.find(wanted.query(0, 0)).found

        self.queries.ask("story", read, lambda answer: self.fruit_shown.emit(answer[0], row, answer[1]))

    def say(self, word: Word, fruit: Sequence[FruitRecord]) -> None:
        """Correct fruit; they are given as they are before."""
        self.queries.change(lambda: word.say(self._store), lambda said: self._said(said, undoing(said, fruit)))

    def undo(self, lot: int | None) -> None:
        """Take the last correction of a lot's fruit back; what is seen is what changes."""
        words = self._undo[lot].take()

        def say() -> None:
            for word in words:
                word.say(self._store)

        if words:
            self.queries.change(say, lambda _: self.corrected.emit(words[0]))

    def _said(self, word: Word, back: list[Word]) -> None:
        if back:
            self._undo[word.lot].add(back)
        self.corrected.emit(word)

    def _read_fruit(self, key: int) -> ShownFruit:
        story = self._store.fruit.story(key)
        station = self._station_of(story.fruit.lot)
        return ShownFruit(story.fruit, story.corrections, view_pictures(story.crops), way(story.path, station))

    def _station_of(self, lot: int) -> Station | None:
        """Return the station that a lot ran on; None where it was not kept or cannot be read any more."""
        if self._station is None or self._station[0] != lot:
            text = self._store.lots.station_text(lot)
            try:
                station = None if text is None else station_of(json.loads(text), Path("station.json"))
            except (InputError, ValueError):
                station = None
            self._station = lot, station
        return self._station[1]
