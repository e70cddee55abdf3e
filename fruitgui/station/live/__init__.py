"""The line on live sensors: frames in, fruit counted, and what a screen draws of it."""

from fruitgui.station.live.apart import LineApart
from fruitgui.station.live.counting import Counting
from fruitgui.station.live.intake import FLAT_OUT, LIVE, PLAYED, Intake
from fruitgui.station.live.live_line import LiveLine
from fruitgui.station.live.state import (
    Finished,
    LiveState,
    LiveWarning,
    Opinion,
    Phase,
    Pictured,
    Preview,
    Spot,
    Spread,
    TrackNow,
)

__all__ = [
    "FLAT_OUT",
    "LIVE",
    "PLAYED",
    "Counting",
    "Finished",
    "Intake",
    "LineApart",
    "LiveLine",
    "LiveState",
    "LiveWarning",
    "Opinion",
    "Phase",
    "Pictured",
    "Preview",
    "Spot",
    "Spread",
    "TrackNow",
]
