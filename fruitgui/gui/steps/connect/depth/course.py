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
    RaisedSensor,
    SeenFlat,
)
from fruitgui.calibration.still import Still
from fruitgui.station.depth_watch import Aim, Looked


class Stage(StrEnum):
    """Where a person is."""

    BELT = "belt"
    BOARD = "board"
    BALL = "ball"
    RAISED = "raised"
    RESULT = "result"


LOOKED = {
    Stage.BELT: Looked.BELT,
    Stage.BOARD: Looked.BOARD,
    Stage.BALL: Looked.BALL,
    Stage.RAISED: Looked.RAISED,
}


@dataclass(frozen=True, slots=True)
class Typed:
    """What a person typed, mm; a distance of 0 was not measured."""

    distance_mm: float = 0.0
    height_mm: float = 200.0
    diameter_mm: float = 100.0
    raised_mm: float = 300.0


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """What was taken of one sensor so far.

    Attributes:
        sensor: its name.
        stage: where the person is.
        belt: taken first. seen: in it, by which boards and balls are found.
        boards, balls, raised: taken.
        before: the course before its last step; None where there was none.
        outcome: what it came to; None before.
    """

    sensor: str
    stage: Stage = Stage.BELT
    belt: BareBelt | None = None
    seen: SeenFlat | None = None
    boards: tuple[RaisedBoard, ...] = ()
    balls: tuple[BallOnBelt, ...] = ()
    raised: tuple[RaisedSensor, ...] = ()
    before: Course | None = None
    outcome: DepthFit | DepthRefusal | None = None

    def taken(self, still: Still, seen: SeenFlat | None, typed: Typed) -> Course:
        """Return the course with a picture of what its stage is about, at the stage that comes next."""
        if self.stage is Stage.BELT:
            distance_m = typed.distance_mm * 1e-3 if typed.distance_mm > 0 else None
            return replace(self.at(Stage.BOARD), belt=BareBelt(still, distance_m), seen=seen)
        if self.stage is Stage.BOARD:
            return replace(self.passed(), boards=(*self.boards, RaisedBoard(still, typed.height_mm * 1e-3)))
        if self.stage is Stage.BALL:
            return replace(self.passed(), balls=(*self.balls, BallOnBelt(still, typed.diameter_mm * 1e-3)))
        return replace(self.passed(), raised=(*self.raised, RaisedSensor(still, typed.raised_mm * 1e-3)))

    def passed(self) -> Course:
        """Return the course at the stage that comes next, without anything taken at this one.

        The sensor is raised last: it never hangs again quite where it was, and box and ball are found by the belt as it
        was first.
        """
        if self.stage is Stage.BOARD and not self.balls:
            return self.at(Stage.BALL)
        return self.at(Stage.RESULT if self.stage is Stage.RAISED else Stage.RAISED)

    def at(self, stage: Stage) -> Course:
        """Return the course at another stage, with all that was taken."""
        return replace(self, stage=stage, before=self, outcome=None)

    def came_to(self, outcome: DepthFit | DepthRefusal) -> Course:
        """Return the course with its outcome."""
        return replace(self, stage=Stage.RESULT, outcome=outcome)

    def measurements(self) -> Measurements | None:
        """Return everything that was taken; None without the belt."""
        return None if self.belt is None else Measurements(self.belt, self.boards, self.balls, self.raised)

    def aim(self, typed: Typed) -> Aim:
        """Return what is looked for at the present stage, and what length was typed of it."""
        lengths_mm = {Stage.BOARD: typed.height_mm, Stage.BALL: typed.diameter_mm, Stage.RAISED: typed.raised_mm}
        return Aim(LOOKED.get(self.stage, Looked.BELT), lengths_mm.get(self.stage, 0.0) * 1e-3, self.seen)

    @property
    def can_pass(self) -> bool:
        """Whether the present stage may be left out: one height alone tells nothing."""
        optional = self.stage in (Stage.BOARD, Stage.BALL)
        return optional or (self.stage is Stage.RAISED and bool(self.boards or self.balls or self.raised))

    @property
    def fit(self) -> DepthFit | None:
        """The correction, where there is one."""
        return self.outcome if isinstance(self.outcome, DepthFit) else None
