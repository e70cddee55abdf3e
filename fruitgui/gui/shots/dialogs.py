"""Small dialogs, each in the middle of a window's room."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QDialog, QLineEdit, QVBoxLayout, QWidget

from fruitgui.gui.settings_dialog import SettingsDialog
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.live.end_dialog import EndDialog
from fruitgui.gui.steps.live.lot_dialog import LotDialog
from fruitgui.records.lot import Lot
from fruitgui.station.settings import Settings


class Room(QWidget):
    """Shows a dialog as it opens; made anew in another language, as it would be."""

    def __init__(self, make: Callable[[], QDialog]) -> None:
        super().__init__()
        self._make = make
        self._shown: QDialog | None = None
        self.setProperty("role", "ground")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._column = QVBoxLayout(self)
        self._open()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Open it anew."""
        if event.type() == QEvent.Type.LanguageChange:
            self._open()
        super().changeEvent(event)

    def _open(self) -> None:
        if self._shown is not None:
            self._column.removeWidget(self._shown)
            self._shown.deleteLater()
        self._shown = self._make()
        first = self._shown.focusWidget() or self._shown.findChild(QLineEdit)
        self._shown.setWindowFlags(Qt.WindowType.Widget)
        self._column.addWidget(self._shown, 0, Qt.AlignmentFlag.AlignCenter)
        self._shown.setVisible(True)
        if first is not None:
            first.setFocus()  # as it has it in a window of its own


@contextmanager
def _opened(stage: Stage, make: Callable[[], QDialog]) -> Iterator[QWidget]:
    room = Room(make)
    room.show()
    try:
        yield room
    finally:
        room.close()
        room.deleteLater()
        stage.settle()


def _lot_dialog() -> QDialog:
    return LotDialog("1185", ("Fundo El Peñón",))


def _end_dialog() -> QDialog:
    lot = Lot(1, "1184", "Fundo El Peñón", "", "", "kinect_1", None, None, {}, (), 0.0, None, ())
    return EndDialog(lot, 12_480, running=True)


SCENES: tuple[Scene, ...] = (
    Scene("dialog-new-lot", partial(_opened, make=_lot_dialog)),
    Scene("dialog-end-lot", partial(_opened, make=_end_dialog)),
    Scene("dialog-settings", partial(_opened, make=lambda: SettingsDialog(Settings(least_free_mb=500)))),
)
