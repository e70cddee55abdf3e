"""What the belt's screen says: what to do next. Plain words, no widgets."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.steps.belt.draft import Draft

translate = QCoreApplication.translate


def advice(draft: Draft, *, done: bool, measuring: bool) -> str:
    """Return what to do next.

    Args:
        draft: the belt as it stands on the screen. done: it is saved for these sensors.
        measuring: the belt's motion is being measured.
    """
    if draft.problem == "heights":
        return translate("BeltPage", "The tallest fruit must be taller than the shortest.")
    if done:
        return translate("BeltPage", "The belt is set. Drag a corner to change it.")
    if measuring:
        return translate("BeltPage", "Fruit must pass before the sensors now.")
    return translate("BeltPage", "Drag the corners to where fruit may be, set how the belt moves, then save.")
