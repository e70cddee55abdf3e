"""What trying projectors came to: how each settles, whom it disturbs, and what of it is worth keeping."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from fruitgui.calibration.projectors.interference import Interference
from fruitgui.calibration.projectors.settling import Refusal, Settled
from fruitgui.station.projectors import MeasuredInterference, MeasuredSettling, Projectors

_MEASURED = ("holes_alone", "holes_together", "noise_alone_mm", "noise_together_mm", "harm")


@dataclass(frozen=True, slots=True, eq=False)
class Pair:
    """Two sensors that were tried together.

    Attributes:
        sensors: both, by name.
        seen: what the other's light does to each; None where that could not be told.
    """

    sensors: tuple[str, str]
    seen: tuple[Interference, Interference] | None

    def measured(self) -> dict[str, Any]:
        """Return what was measured of each of both, by name; nothing where that could not be told."""
        return {name: tuple(getattr(one, name) for one in self.seen) for name in _MEASURED} if self.seen else {}


@dataclass(frozen=True, slots=True, eq=False)
class Tried:
    """What trying the projectors came to.

    Attributes:
        alone: by sensor, how it settles, or why that cannot be told.
        pairs: of those that could be told alone.
        projectors: what is worth keeping of it.
    """

    alone: Mapping[str, Settled | Refusal]
    pairs: tuple[Pair, ...]
    projectors: Projectors

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {
            "projectors": {sensor: _alone_value(found) for sensor, found in self.alone.items()},
            "pairs": [_pair_value(pair) for pair in self.pairs],
        }


def _alone_value(found: Settled | Refusal) -> dict[str, Any]:
    if isinstance(found, Refusal):
        return {"refused": found.value}
    return {
        "settle_s": found.settle_s, "discard_frames": found.discard_frames, "steady_s": found.steady_s,
        "trials": found.trials, "holes": found.steady.holes, "noise_mm": found.steady.noise_mm,
    }  # fmt: skip


def _pair_value(pair: Pair) -> dict[str, Any]:
    value: dict[str, Any] = {"sensors": list(pair.sensors)}
    if pair.seen is None:
        return {**value, "refused": Refusal.TOO_FEW.value}
    measured = {name: list(both) for name, both in pair.measured().items()}
    return {**value, **measured, "harm": [one.harm.value for one in pair.seen]}


def worth_keeping(
    told: Mapping[str, Settled], pairs: Sequence[Pair], serials: Mapping[str, str], when: datetime
) -> Projectors:
    """Return what was measured of devices that can be told again by their serials."""
    settlings = {
        serials[sensor]: MeasuredSettling(
            settle_s=one.settle_s, discard_frames=one.discard_frames, steady_s=one.steady_s, holes=one.steady.holes,
            trials=one.trials, when=when,
        )
        for sensor, one in told.items()
        if serials[sensor]
    }  # fmt: skip
    interferences = tuple(
        MeasuredInterference(serials=(serials[pair.sensors[0]], serials[pair.sensors[1]]), when=when, **pair.measured())
        for pair in pairs
        if pair.seen is not None and all(serials[one] for one in pair.sensors)
    )
    return Projectors(settlings=settlings, interferences=interferences)
