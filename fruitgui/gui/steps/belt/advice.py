"""What the belt's screen says: what to do next. Plain words, no widgets."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.step_words import reason_text
from fruitgui.gui.steps.belt.draft import Draft
from fruitgui.station.workflow import State, StepState

translate = QCoreApplication.translate


def advice(draft: Draft, belt: StepState, *, done: bool, measuring: bool, connected: bool) -> str:
    """Return what to do next.

    Args:
        draft: the belt as it stands on the screen. belt: how far the step is.
        done: it is saved for these sensors. measuring: the belt's motion is being measured.
        connected: sensors run.
    """
    if draft.problem == "heights":
        return translate("BeltPage", "The tallest fruit must be taller than the shortest.")
    if done:
        return translate("BeltPage", "The belt is set. Drag a corner to change it.")
    if measuring:
        return translate("BeltPage", "Fruit must pass before the sensors now.")
    if not connected:
        return translate("BeltPage", "No sensor runs: connect them to see the belt, and to measure how it moves.")
    if belt.state is State.REDO:
        again = translate("BeltPage", "Look whether the region still fits, then save it.")
        return f"{reason_text(belt)} {again}"
    return translate("BeltPage", "Drag the corners to where fruit may be, set how the belt moves, then save.")
