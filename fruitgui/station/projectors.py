"""What was measured of the projectors of a line's sensors, kept by serial."""

from __future__ import annotations

from typing import Annotated

from pydantic import AwareDatetime, Field

from fruitgui.sensors.turns import Settling
from fruitgui.station.written import Written

Share = Annotated[float, Field(ge=0.0, le=1.0)]


class MeasuredSettling(Written):
    """How long one device's depth is of no use after its projector was switched on.

    Attributes:
        settle_s, discard_frames: what is waited for.
        steady_s: when its holes were steady, the latest of all trials; what is waited for is a little longer.
        holes: share of its picture without depth, once steady.
        trials: how often it was switched on.
        when: it was measured.
    """

    settle_s: Annotated[float, Field(ge=0.0, le=10.0)]
    discard_frames: Annotated[int, Field(ge=0, le=300)]
    steady_s: Annotated[float, Field(ge=0.0, le=10.0)]
    holes: Share
    trials: Annotated[int, Field(ge=1)]
    when: AwareDatetime

    def settling(self) -> Settling:
        """Return what the turns need of it."""
        return Settling(self.settle_s, self.discard_frames)


class MeasuredInterference(Written):
    """How much two sensors blind each other.

    Attributes:
        serials: of both.
        holes_alone, holes_together: of each, share of its picture without depth with its own projector on, and both.
        when: it was measured.
    """

    serials: tuple[str, str]
    holes_alone: tuple[Share, Share]
    holes_together: tuple[Share, Share]
    when: AwareDatetime


class Projectors(Written):
    """All that was measured.

    Attributes:
        settlings: by serial.
        interferences: of pairs, each once.
    """

    settlings: dict[str, MeasuredSettling] = Field(default_factory=dict)
    interferences: tuple[MeasuredInterference, ...] = ()
