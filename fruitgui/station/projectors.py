"""What was measured of the projectors of a line's sensors, kept by serial."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import AwareDatetime, Field

from fruitgui.calibration.projectors.interference import Harm
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.sensors.turns import Settling
from fruitgui.station.written import Written

Share = Annotated[float, Field(ge=0.0, le=1.0)]
Millimetres = Annotated[float, Field(ge=0.0, le=1e4)]


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
        noise_alone_mm, noise_together_mm: of each, one reading's standard deviation, likewise.
        harm: of each, in a word.
        when: it was measured.
    """

    serials: tuple[str, str]
    holes_alone: tuple[Share, Share]
    holes_together: tuple[Share, Share]
    noise_alone_mm: tuple[Millimetres, Millimetres]
    noise_together_mm: tuple[Millimetres, Millimetres]
    harm: tuple[Harm, Harm]
    when: AwareDatetime

    @property
    def disturbs(self) -> bool:
        """Whether one of them is harmed by the other's light."""
        return any(harm is not Harm.NONE for harm in self.harm)


class Projectors(Written):
    """All that was measured.

    Attributes:
        settlings: by serial.
        interferences: of pairs, each once.
    """

    settlings: dict[str, MeasuredSettling] = Field(default_factory=dict)
    interferences: tuple[MeasuredInterference, ...] = ()

    def known(self) -> dict[str, Settling]:
        """Return how long each device settles, by serial."""
        return {serial: one.settling() for serial, one in self.settlings.items()}

    def renewed(self, newer: Projectors) -> Projectors:
        """Return this with what was measured anew in the place of what was measured before."""
        pairs = {frozenset(one.serials): one for one in (*self.interferences, *newer.interferences)}
        return Projectors(settlings={**self.settlings, **newer.settlings}, interferences=tuple(pairs.values()))

    def disturbing(self, infos: Iterable[SensorInfo]) -> tuple[tuple[str, str], ...]:
        """Return those pairs of sensors, by name, of which one was measured to be harmed by the other's light."""
        names = {info.serial: info.sensor for info in infos if info.serial}
        return tuple(
            (names[one], names[other])
            for measured in self.interferences
            for one, other in (measured.serials,)
            if measured.disturbs and one in names and other in names and one != other
        )
