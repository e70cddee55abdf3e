"""How far a measurement of a device's depth is: what was taken, and what comes next. Plain data."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

from fruitgui.calibration.depth.measured import (
    BallOnBelt,
    BareBelt,
    DepthFit,
    DepthRefusal,
    Measurements,
    RaisedBoard,
    SeenFlat,
)
from fruitgui.calibration.still import Still


class Stage(StrEnum):
    """Where a person is."""

    BELT = "belt"
    BOARD = "board"
    BALL = "ball"
    RESULT = "result"


@dataclass(frozen=True, slots=True)
class Typed:
    """What a person typed, mm; a distance of 0 was not measured."""

    distance_mm: float = 0.0
    height_mm: float = 200.0
    diameter_mm: float = 100.0


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """What was taken of one sensor so far.

    Attributes:
        sensor: its name.
        stage: where the person is.
        belt: taken first. seen: in it, by which boards and balls are found.
        boards, balls: taken.
        outcome: what it came to; None before.
    """

    sensor: str
    stage: Stage = Stage.BELT
    belt: BareBelt | None = None
    seen: SeenFlat | None = None
    boards: tuple[RaisedBoard, ...] = ()
    balls: tuple[BallOnBelt, ...] = ()
    outcome: DepthFit | DepthRefusal | None = None

    def taken(self, still: Still, seen: SeenFlat | None, typed: Typed) -> Course:
        """Return the course with a picture of what its stage is about, at the stage that comes next."""
        if self.stage is Stage.BELT:
            distance_m = typed.distance_mm * 1e-3 if typed.distance_mm > 0 else None
            return replace(self, belt=BareBelt(still, distance_m), seen=seen, stage=Stage.BOARD)
        if self.stage is Stage.BOARD:
            return replace(self, boards=(*self.boards, RaisedBoard(still, typed.height_mm * 1e-3)), stage=Stage.BALL)
        ball = BallOnBelt(still, typed.diameter_mm * 1e-3)
        return replace(self, balls=(*self.balls, ball), stage=Stage.RESULT)

    def at(self, stage: Stage) -> Course:
        """Return the course at another stage, with all that was taken."""
        return replace(self, stage=stage)

    def came_to(self, outcome: DepthFit | DepthRefusal) -> Course:
        """Return the course with its outcome."""
        return replace(self, stage=Stage.RESULT, outcome=outcome)

    def measurements(self) -> Measurements | None:
        """Return everything that was taken; None without the belt."""
        return None if self.belt is None else Measurements(self.belt, self.boards, self.balls)

    @property
    def fit(self) -> DepthFit | None:
        """The correction, where there is one."""
        return self.outcome if isinstance(self.outcome, DepthFit) else None
