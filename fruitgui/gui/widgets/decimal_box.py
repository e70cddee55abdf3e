"""A box for a decimal number that reads it as it was meant, with a point or a comma.

Qt's own takes the sign that groups thousands in the window's language as if it were not there: "0.5" typed in Spanish,
or "0,5" in English, is five.
"""

from __future__ import annotations

import re

from PySide6.QtCore import QEvent
from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QDoubleSpinBox

from fruitgui.gui.numbers import number_text

_NUMBER = re.compile(r"(?P<minus>-?)(?P<whole>\d*)(?:(?P<sign>[.,])(?P<part>\d*))?")


class DecimalBox(QDoubleSpinBox):
    """Takes a point and a comma alike, shows the sign of the window's language, and refuses signs between thousands."""

    def textFromValue(self, value: float) -> str:  # noqa: N802 - Qt's name
        """Return the number as it is shown."""
        return number_text(value, self.decimals())

    def valueFromText(self, text: str) -> float:  # noqa: N802 - Qt's name
        """Return what was typed; the least where that is no number."""
        value = read_decimal(self._bare(text))
        return self.minimum() if value is None else value

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        """Tell whether a text is a number within the limits, may become one, or never will."""
        return self._state(text), text, position

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Show the number anew in another language."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.LanguageChange:
            self.setSuffix(self.suffix())  # the only call that writes the text again and leaves the value alone

    def _bare(self, text: str) -> str:
        """Return a text without what stands before and after the number."""
        return text.removeprefix(self.prefix()).removesuffix(self.suffix()).strip()

    def _state(self, text: str) -> QValidator.State:
        if self.specialValueText() and text == self.specialValueText():
            return QValidator.State.Acceptable
        bare = self._bare(text)
        found = _NUMBER.fullmatch(bare)
        if found is None or len(found["part"] or "") > self.decimals():
            return QValidator.State.Invalid
        if found["minus"] and self.minimum() >= 0.0:
            return QValidator.State.Invalid
        value = read_decimal(bare)
        if value is None or (found["sign"] and not self.decimals()):
            return QValidator.State.Intermediate  # "1." of what would be 1.5 stands, so that no 15 comes of it
        if self.minimum() <= value <= self.maximum():
            return QValidator.State.Acceptable
        # More digits lead further from zero, never back.
        beyond = value > max(self.maximum(), 0.0) or value < min(self.minimum(), 0.0)
        return QValidator.State.Invalid if beyond else QValidator.State.Intermediate


def read_decimal(text: str) -> float | None:
    """Return a number that has at most one sign, a point or a comma, before its decimals; None for anything else."""
    found = _NUMBER.fullmatch(text.strip())
    if found is None or not (found["whole"] or found["part"]):
        return None
    return float(f"{found['minus']}{found['whole'] or '0'}.{found['part'] or '0'}")
