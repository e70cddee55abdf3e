"""Corrections by hand, and taking them back; no widgets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.records.store import Store

translate = QCoreApplication.translate

MOST_STEPS = 100


class Deed(StrEnum):
    """What a person says of fruit."""

    NAME = "name"
    LEAVE_OUT = "leave_out"
    PUT_BACK = "put_back"
    ADD = "add"


@dataclass(frozen=True, slots=True)
class Word:
    """One thing said of some fruit.

    Attributes:
        deed: what. fruit: keys. kind: for `NAME` and `ADD`. note: in a person's words.
        lot: key of the lot whose fruit they are, or that one is added to.
    """

    deed: Deed
    fruit: tuple[int, ...]
    kind: str = ""
    note: str = ""
    lot: int | None = None

    def say(self, store: Store) -> Word:
        """Keep it; return it with the fruit of which it was said: one that was added has a key only now.

        Raises:
            InputError, WorldError: see `Corrections.name`.
        """
        if self.deed is Deed.ADD and self.lot is not None:
            return replace(self, fruit=(store.corrections.add(self.lot, self.kind, note=self.note),))
        if self.deed is Deed.NAME:
            store.corrections.name(self.fruit, self.kind, note=self.note)
        elif self.deed is Deed.LEAVE_OUT:
            store.corrections.leave_out(self.fruit, note=self.note)
        else:
            store.corrections.put_back(self.fruit, note=self.note)
        return self

    @property
    def text(self) -> str:
        """What was done, in a sentence."""
        one = len(self.fruit) == 1
        if self.deed is Deed.NAME:
            text = (
                translate("Lots", "1 fruit named {kind}.") if one else translate("Lots", "{count} fruit named {kind}.")
            )
        elif self.deed is Deed.ADD:
            text = translate("Lots", "1 fruit added: {kind}.")
        elif self.deed is Deed.LEAVE_OUT:
            text = translate("Lots", "1 fruit left out.") if one else translate("Lots", "{count} fruit left out.")
        else:
            text = translate("Lots", "1 fruit put back.") if one else translate("Lots", "{count} fruit put back.")
        return text.format(count=count_text(len(self.fruit)), kind=kind_name(self.kind))


def undoing(word: Word, fruit: Sequence[FruitRecord]) -> list[Word]:
    """Return what takes a word back; what people said stays in the history, the newest holds.

    Args:
        word: that was said.
        fruit: as they were before it.
    """
    if word.deed is Deed.ADD:
        return [Word(Deed.LEAVE_OUT, word.fruit, lot=word.lot)]
    if word.deed is Deed.LEAVE_OUT:
        keys = tuple(one.key for one in fruit if one.counted)
        return [Word(Deed.PUT_BACK, keys, lot=word.lot)] if keys else []
    if word.deed is Deed.PUT_BACK:
        keys = tuple(one.key for one in fruit if not one.counted)
        return [Word(Deed.LEAVE_OUT, keys, lot=word.lot)] if keys else []
    kinds = dict.fromkeys(one.kind for one in fruit)
    named = ((kind, tuple(one.key for one in fruit if one.kind == kind)) for kind in kinds)
    return [Word(Deed.NAME, keys, kind, lot=word.lot) for kind, keys in named]


class Undo:
    """What can be taken back, the newest first."""

    def __init__(self) -> None:
        self._steps: list[list[Word]] = []

    def __len__(self) -> int:
        return len(self._steps)

    def add(self, step: list[Word]) -> None:
        """Remember how to take something back."""
        self._steps = [*self._steps[-MOST_STEPS + 1 :], step]

    def take(self) -> list[Word]:
        """Return the newest step and forget it; nothing where there is none."""
        return self._steps.pop() if self._steps else []
