"""What a tile of the grid shows beside its picture; no widgets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import percent_text
from fruitgui.gui.steps.teach.desk import Desk
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark, Looks, kind_marks
from fruitgui.records.insight import Guess
from fruitgui.records.teaching import Brief


@dataclass(frozen=True, slots=True)
class Tile:
    """One fruit.

    Attributes:
        mark: of its kind, or of what it seems to be; None while nobody says anything.
        words: what is said of it, in full.
        guessed: a model says so, not a person.
        measured: it is a reference fruit.
        other: the mark of what a model takes it for, against a person's word; None where they agree.
        short: the words beside the mark; what is sure stands apart.
        sure: how surely a model says so, as a percentage.
    """

    mark: KindMark | None
    words: str
    guessed: bool
    measured: bool
    other: KindMark | None = None
    short: str = ""
    sure: str = ""


class TileSource(Protocol):
    """Says what tiles show."""

    def tile(self, key: int) -> Tile:
        """Return what is shown of a fruit."""


class Tiles:
    """Says what a tile shows, by what lies on the desk."""

    def __init__(self, desk: Desk, looks: Looks = kind_marks) -> None:
        self._desk = desk
        self._looks = looks
        self._order: tuple[str, ...] = ()
        self._marks: dict[str, KindMark] = kind_marks(())

    @property
    def marks(self) -> dict[str, KindMark]:
        """The marks of all kinds, in the order of their keys."""
        if self._order != self._desk.order:
            self._order = self._desk.order
            self._marks = self._looks(self._order)
        return self._marks

    def tile(self, key: int) -> Tile:
        """Return what is shown of a fruit."""
        one, guess = self._desk.fruit.get(key), self._desk.guess(key)
        if one is None:
            return Tile(None, "", guessed=False, measured=False)
        if one.kind is None and guess is None:
            return Tile(None, "", guessed=False, measured=one.measured)
        if guess is not None:
            return self._guessed(one, guess)
        kind = one.kind or ""
        return Tile(self._mark(kind), kind_name(kind), False, one.measured, None, kind_name(kind))

    def _guessed(self, one: Brief, guess: Guess) -> Tile:
        sure = percent_text(guess.probability)
        words = f"{kind_name(guess.kind)} {sure}"
        if one.kind is None:
            return Tile(self._mark(guess.kind), words, True, one.measured, None, kind_name(guess.kind), sure)
        said = QCoreApplication.translate("Teach", "{kind}, or {other}?")
        both = said.format(kind=kind_name(one.kind), other=words)
        return Tile(self._mark(one.kind), both, True, one.measured, self._mark(guess.kind), "", sure)

    def _mark(self, kind: str) -> KindMark:
        return self.marks.get(kind, UNKNOWN_MARK)

    def described(self, key: int) -> str:
        """Return what a screen reader says of a fruit."""
        tile, one = self.tile(key), self._desk.fruit.get(key)
        source = "" if one is None else one.source
        return f"{tile.words or QCoreApplication.translate('Teach', 'Not named yet')}. {source}"
