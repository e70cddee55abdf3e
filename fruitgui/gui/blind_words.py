"""Which part of the belt nobody sees, or not often enough, in words."""

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
    text = translate("Blind", "{sensors} away: no sensor sees {lanes}")
    return text.format(sensors=sensors, lanes=_lanes_text(blind))


def sparse_text(sparse: Blind) -> str:
    """Return who gives too few pictures, and what of the belt no other sensor sees: one line."""
    sensors = ", ".join(sparse.sensors)
    if not sparse.loses_fruit:
        text = translate(
            "Blind", "{sensors}: too few pictures at this speed; another sensor sees every part of the belt"
        )
        return text.format(sensors=sensors)
    if sparse.lanes_m is None:
        text = translate("Blind", "{sensors}: too few pictures at this speed; no other sensor sees {share} of the belt")
        return text.format(sensors=sensors, share=percent_text(max(sparse.share, 0.01)))
    text = translate("Blind", "{sensors}: too few pictures at this speed; no other sensor sees {lanes}")
    return text.format(sensors=sensors, lanes=_lanes_text(sparse))


def _lanes_text(blind: Blind) -> str:
    return "; ".join(_lane_text(side, lane) for side, lane in zip(blind.sides, blind.lanes_m or (), strict=True))


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


def sparse_remedy(sparse: Blind) -> str:
    """Return what that means, and what to do."""
    if sparse.loses_fruit:
        return translate("Blind", "Fruit there may be missed. Slow the belt down; step 1 says why pictures are lost.")
    return translate("Blind", "Sizes are less sure meanwhile. Slow the belt down; step 1 says why pictures are lost.")
