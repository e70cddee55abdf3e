"""What the calibrating screen says: what to do next. Plain words, no widgets."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.step_words import reason_text
from fruitgui.station.workflow import State, StepState

translate = QCoreApplication.translate


def prepare_advice(state: StepState, *, ready: bool, running: bool) -> str:
    """Return what to do before calibrating, and why it is to be done again.

    Args:
        state: how far the step is. ready: all sensors give pictures. running: a lot runs, which goes before.
    """
    if running:
        return translate("CalibratePage", "The line runs. Its sensors can be calibrated when the lot has ended.")
    if not ready:
        return translate("CalibratePage", "Not all sensors give pictures; look after them on the screen “Connect”.")
    put = translate(
        "CalibratePage", "Put fruit on the belt as in the picture, then press Calibrate. It takes some seconds."
    )
    return f"{reason_text(state)} {put}" if state.state is State.REDO else put
