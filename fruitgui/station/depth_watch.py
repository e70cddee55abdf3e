"""Looks at one sensor while its depth is being measured: what of belt, board or ball it sees now, and from where."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.depth.measured import SeenFlat
from fruitgui.calibration.depth.seeing import read_raised_m, read_rise_m, see_ball, see_belt, see_board, see_from_higher
from fruitgui.calibration.still import Still, average
from fruitgui.errors import FruitguiError
from fruitgui.frame import Bools
from fruitgui.sensors.feed import Feed
from fruitgui.station.looks import Looks
from fruitgui.station.stills import collect_stills

CAPTURES = 3
REST_S, REST_SHARE = 0.3, 1.0
"""It rests at least so long, and as long as it worked: the window and the sensors come first."""


class Looked(StrEnum):
    """What is looked for."""

    BELT = "belt"
    BOARD = "board"
    BALL = "ball"
    RAISED = "raised"


@dataclass(frozen=True, slots=True, eq=False)
class Aim:
    """What is looked for, how high or wide or how far raised it was typed to be, m, and the belt as it was at first."""

    what: Looked
    length_m: float = 0.0
    belt: SeenFlat | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Sight:
    """What was seen at one look.

    Attributes:
        what: was looked for.
        on: (H, W) pixels of it; None where it is not seen.
        length_m: of the belt its distance straight ahead, of a board its height over the belt, of a ball its
            diameter as typed, of a raised sensor how much farther it is from the belt; as read, uncorrected.
        moving: something moves.
    """

    what: Looked
    on: Bools | None
    length_m: float
    moving: bool


def sight_of(still: Still, aim: Aim) -> Sight:
    """Return what a picture shows of what is looked for."""
    moving = bool(still.moved.mean() > MOVING)
    if aim.what is Looked.BELT or aim.belt is None:
        belt = see_belt(still)
        if belt is None:
            return Sight(Looked.BELT, None, 0.0, moving)
        return Sight(Looked.BELT, belt.on, float(1.0 / belt.coefficients[2]), moving)
    if aim.what is Looked.RAISED:
        return _from_higher(still, aim.belt, aim.length_m, moving=moving)
    plane = planes.plane_of(aim.belt.coefficients)
    if aim.what is Looked.BOARD:
        board = see_board(still, plane, aim.length_m)
        on, length_m = (None, 0.0) if board is None else (board.on, read_rise_m(board, plane))
        return Sight(Looked.BOARD, on, length_m, moving)
    ball = see_ball(still, plane, aim.length_m / 2)
    return Sight(Looked.BALL, None if ball is None else ball.on, aim.length_m, moving)


def _from_higher(still: Still, belt: SeenFlat, raised_m: float, *, moving: bool) -> Sight:
    higher = see_from_higher(still, belt, raised_m)
    if higher is None:
        return Sight(Looked.RAISED, None, 0.0, moving)
    return Sight(Looked.RAISED, higher.on, read_raised_m(higher.coefficients, belt.coefficients), moving)


MOVING = 0.005
"""Share of the picture that changes although nothing moves: edges flicker."""


class DepthWatch(Looks):
    """Looks at one sensor for what `aim` says; `newest` is what it saw last."""

    def __init__(self, feed: Feed, sensor: str, aim: Aim) -> None:
        super().__init__(name="depth watch", rest_s=REST_S, rest_share=REST_SHARE)
        self._feed = feed
        self._sensor = sensor
        self.aim = aim
        self.newest: Sight | None = None

    def look(self) -> None:
        """Look for it; nothing where the sensor does not run: the screen that shows its health says why."""
        try:
            self.newest = self._seen(self.aim)
        except FruitguiError:
            self.newest = None

    def _seen(self, aim: Aim) -> Sight | None:
        frames = collect_stills(self._feed, CAPTURES, cancelled=lambda: self.stopping, sensors={self._sensor})
        sight = sight_of(average(frames[self._sensor]), aim)
        return sight if aim is self.aim else None


def belt_of(still: Still) -> SeenFlat | None:
    """Return the belt of the first measurement, by which boards and balls are found."""
    return see_belt(still)


def share_seen(sight: Sight) -> float:
    """Return the share of the picture that what was looked for covers."""
    return 0.0 if sight.on is None else float(np.mean(sight.on))
