"""Which part of the belt nobody sees, in words."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.numbers import THIN, number_text, percent_text
from fruitgui.station.live.blind import Blind

translate = QCoreApplication.translate


def blind_text(blind: Blind) -> str:
    """Return who is away, and what of the belt nobody sees now: one line."""
    sensors = ", ".join(blind.sensors)
    if not blind.loses_fruit:
        return translate("Blind", "{sensors} away: every part of the belt is still seen by another sensor").format(
            sensors=sensors
        )
    if blind.lanes_m is None:
        return translate("Blind", "{sensors} away: {share} of the belt is seen by no sensor").format(
            sensors=sensors, share=percent_text(max(blind.share, 0.01))
        )
    lanes = "; ".join(_lane_text(side, lane) for side, lane in zip(blind.sides, blind.lanes_m, strict=True))
    return translate("Blind", "{sensors} away: no sensor sees {lanes}").format(sensors=sensors, lanes=lanes)


def _lane_text(side: str, lane_m: tuple[float, float]) -> str:
    words = {
        "whole": translate("Blind", "any of the belt"),
        "left": translate("Blind", "the left part of the belt ({lane} from its right edge)"),
        "middle": translate("Blind", "a middle part of the belt ({lane} from its right edge)"),
        "right": translate("Blind", "the right part of the belt ({lane} from its edge)"),
    }
    lane = f"{number_text(lane_m[0], 2)}–{number_text(lane_m[1], 2)}{THIN}m"
    return words[side].format(lane=lane)


def blind_remedy(blind: Blind) -> str:
    """Return what that means, and what to do."""
    if blind.loses_fruit:
        return translate("Blind", "Fruit there are not counted. Check cable and power; it starts again by itself.")
    return translate("Blind", "Sizes are less sure meanwhile. Check cable and power; it starts again by itself.")
