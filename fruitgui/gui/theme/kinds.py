"""How kinds are told apart: colour, shape and letter together, so that no one of them has to be seen."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum

UNKNOWN = "unknown"


class Shape(Enum):
    """The outline of a kind's mark."""

    CIRCLE = "circle"
    TRIANGLE = "triangle"
    SQUARE = "square"
    DIAMOND = "diamond"
    PENTAGON = "pentagon"
    STAR = "star"
    HEXAGON = "hexagon"
    CROSS = "cross"
    RING = "ring"


@dataclass(frozen=True, slots=True)
class KindMark:
    """A kind's mark: `#rrggbb`, a shape, and one or two letters; `number` says which colour and shape."""

    kind: str
    colour: str
    shape: Shape
    letters: str
    number: int = -1


OKABE_ITO = ("#e69f00", "#56b4e9", "#009e73", "#f0e442", "#3b8ee0", "#d55e00", "#cc79a7", "#b0b0b0")
"""Told apart by people with any colour vision (Okabe and Ito 2008); its blue is lightened for dark grounds."""

_SHAPES = (
    Shape.CIRCLE, Shape.TRIANGLE, Shape.SQUARE, Shape.DIAMOND, Shape.PENTAGON, Shape.STAR, Shape.HEXAGON, Shape.CROSS,
)  # fmt: skip

UNKNOWN_MARK = KindMark(UNKNOWN, "#9aa4ac", Shape.RING, "?")


Marks = dict[str, KindMark]
Looks = Callable[[Iterable[str]], Marks]
"""Gives each kind its mark, always the same one."""


def kind_mark(kind: str, number: int, letters: str) -> KindMark:
    """Return the mark of a number.

    Colour and shape go round at different speeds from the ninth kind on, so that no two of 64 kinds share both.
    """
    shape = _SHAPES[(number + number // len(_SHAPES)) % len(_SHAPES)]
    return KindMark(kind, OKABE_ITO[number % len(OKABE_ITO)], shape, letters, number)


def kind_marks(kinds: Iterable[str], kept: Iterable[KindMark] = ()) -> Marks:
    """Return a mark for each kind, and one for `unknown`.

    Args:
        kinds: that are to have one; a new kind gets the first number and letters that are free.
        kept: marks that kinds have already; they stay as they are.
    """
    known = {mark.kind: mark for mark in kept}
    letters = {UNKNOWN_MARK.letters, *(mark.letters for mark in known.values())}
    numbers = {mark.number for mark in known.values()}
    marks = {UNKNOWN: UNKNOWN_MARK}
    for kind in dict.fromkeys(kinds):
        if kind == UNKNOWN:
            continue
        if kind not in known:
            number = next(one for one in itertools.count() if one not in numbers)
            known[kind] = kind_mark(kind, number, _letters(kind, letters))
            numbers.add(number)
            letters.add(known[kind].letters)
        marks[kind] = known[kind]
    return marks


def _letters(kind: str, taken: set[str]) -> str:
    """Return the kind's first letter, or with one more of its letters or a number where that is taken."""
    words = [word for word in kind.split() if word]
    first = (words[0][0] if words else "?").upper()
    seconds = [word[0].lower() for word in words[1:]] + [one.lower() for one in kind[1:] if one.isalnum()]
    numbers = [str(number) for number in range(1, 100)]
    return next(text for text in (first, *(first + second for second in (*seconds, *numbers))) if text not in taken)
