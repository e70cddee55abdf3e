"""What the window says, as words that are found when they are shown: so they are in the language in force then."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

Words = Callable[[], str]
"""Returns some words in the language that the window speaks now."""


@dataclass(frozen=True, slots=True)
class Told:
    """What a person reads of one thing.

    Attributes:
        what: what happened, and what it means.
        remedy: what to do; empty where there is nothing to do.
        action: a word on a button; empty where there is none.
    """

    what: str
    remedy: str = ""
    action: str = ""


Telling = Callable[[], Told]
"""Returns what a person reads in the language that the window speaks now."""
