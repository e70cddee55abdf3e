"""Small dialogs, each in the middle of a window's room."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QDialog, QLineEdit, QVBoxLayout, QWidget

from fruitgui.gui.closing import LossDialog
from fruitgui.gui.help_window import HelpWindow
from fruitgui.gui.settings_dialog import SettingsDialog
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.live.end_dialog import EndDialog
from fruitgui.gui.steps.live.lot_dialog import LotDialog
from fruitgui.gui.steps.teach.densities import DensitiesDialog
from fruitgui.gui.steps.teach.desk import KindLine
from fruitgui.gui.theme.kinds import kind_marks
from fruitgui.records.lot import Lot
from fruitgui.station.settings import Settings
from fruitgui.station.workflow import Step


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


DENSITIES_G_ML = {"lemon": 0.94, "red_apple": 0.81, "green_apple": None, "chilean_avocado": 0.967, "orange": None}
"""As reference fruit taught them; of some kinds none was weighed."""


def _densities_dialog(more: int = 0, typed: str = "") -> QDialog:
    """Return the dialog for five kinds and some more, with something typed for the last of the five."""
    known = [*DENSITIES_G_ML, *(f"orange, orchard {number}" for number in range(1, more + 1))]
    lines = [KindLine(kind, "", 60, 12, 3, DENSITIES_G_ML.get(kind)) for kind in known]
    dialog = DensitiesDialog(lines, kind_marks(known), {"green_apple": 0.84})
    if typed:
        dialog.fields["orange"].setText(typed)
    return dialog


def _shortened() -> QDialog:
    """Return the settings with a number of days that lets pictures go."""
    dialog = SettingsDialog(Settings())
    dialog.pictures.choice.setCurrentIndex(dialog.pictures.choice.count() - 1)
    dialog.pictures.own.setValue(45)
    return dialog


@contextmanager
def _help(stage: Stage, step: Step | None = None) -> Iterator[QWidget]:
    window = HelpWindow(stage.theme, stage.language, stage.folder / "log.txt")
    window.show()
    if step is not None:
        window.show_step(step)
    try:
        yield window
    finally:
        window.close()
        window.deleteLater()
        stage.settle()


SCENES: tuple[Scene, ...] = (
    Scene("dialog-new-lot", partial(_opened, make=_lot_dialog)),
    Scene("dialog-end-lot", partial(_opened, make=_end_dialog)),
    Scene("dialog-close-full", partial(_opened, make=lambda: LossDialog(1_204))),
    Scene("dialog-settings", partial(_opened, make=lambda: SettingsDialog(Settings(least_free_mb=500)))),
    Scene("dialog-settings-own", partial(_opened, make=_shortened)),
    Scene("dialog-densities", partial(_opened, make=_densities_dialog)),
    Scene("dialog-densities-wrong", partial(_opened, make=partial(_densities_dialog, typed="9.4"))),
    Scene("dialog-densities-many", partial(_opened, make=partial(_densities_dialog, more=9))),
    Scene("help-begin", _help),
    Scene("help-calibrate", partial(_help, step=Step.CALIBRATE)),
    Scene("help-live", partial(_help, step=Step.LIVE)),
)
