"""How much two sensors blind each other: what one sees with its own light only, against with both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from fruitgui.calibration.projectors.glimpse import SPREADS, Glimpse, Level

LEAST_TOGETHER = 6

MORE_HOLES, MANY_HOLES = 0.005, 0.05
"""Shares of the picture that may be lost: as much as between two pictures; and a twentieth, which is a fruit's top."""

NOISIER, MUCH_NOISIER = 1.2, 2.0
"""Times by which readings may spread more: what thirty pictures tell; and twice, which doubles a fruit's error."""


class Harm(Enum):
    """How much one sensor is harmed by another's light."""

    NONE = "none"
    SOME = "some"
    MUCH = "much"


@dataclass(frozen=True, slots=True)
class Interference:
    """What another sensor's light does to one.

    Attributes:
        holes_alone, holes_together: share of its picture without depth.
        noise_alone_mm, noise_together_mm: standard deviation of one reading from picture to picture.
        holes_std: of a picture's holes, from picture to picture.
    """

    holes_alone: float
    holes_together: float
    noise_alone_mm: float
    noise_together_mm: float
    holes_std: float

    @property
    def harm(self) -> Harm:
        """How much it is harmed."""
        lost = self.holes_together - self.holes_alone
        noisier = self.noise_together_mm / max(self.noise_alone_mm, 1e-3)
        if lost > MANY_HOLES or noisier > MUCH_NOISIER:
            return Harm.MUCH
        if lost > max(MORE_HOLES, SPREADS * self.holes_std) or noisier > NOISIER:
            return Harm.SOME
        return Harm.NONE


def interference(steady: Level, together: Sequence[Glimpse]) -> Interference | None:
    """Return what a sensor sees less, or worse; None where there are too few pictures to tell.

    Args:
        steady: what its own light gives.
        together: its pictures while the other's light was steady, too.
    """
    if len(together) < LEAST_TOGETHER:
        return None
    both = Level.of(together)
    return Interference(steady.holes, both.holes, steady.noise_mm, both.noise_mm, max(steady.holes_std, both.holes_std))
