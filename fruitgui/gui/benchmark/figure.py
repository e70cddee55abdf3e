"""One line of what the benchmark prints: what was asked beside what was measured."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Figure:
    """One figure.

    Attributes:
        what: was measured.
        measured: in words, with its unit.
        asked: of it; empty where it is only told.
        met: whether it is as asked; None where nothing is asked.
        more: that goes with it.
    """

    what: str
    measured: str
    asked: str = ""
    met: bool | None = None
    more: str = ""

    def line(self) -> str:
        """Return it as a line of a table; `!` marks what is not as asked."""
        mark = "!" if self.met is False else " "
        return f"{mark} {self.what:<44} {self.asked:>12} {self.measured:>16}  {self.more}".rstrip()


def head() -> str:
    """Return the line above the figures."""
    return Figure("", "measured", "asked").line()
