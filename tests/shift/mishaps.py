"""What goes wrong in a shift, drawn from a seed: one thing at a time, and time to recover after each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tests.emulated_usb.emulation import Hang
from tests.emulated_usb.player import Fault

FIRST_S, RECOVERY_S = 15.0, 12.0
"""Sensors are opened again within some seconds; so long after a mishap nothing new happens."""

SORTS = ("unplugged", "silence", "loss", "garbage", "stall", "hang", "clock_jump", "standstill")


@dataclass(frozen=True, slots=True)
class Mishap:
    """One thing that went wrong with one sensor, or with all.

    Attributes:
        what: unplugged, silence, loss, garbage, stall, hang, clock_jump, or standstill (no sensor gives anything).
        kinects: their numbers.
        from_s, to_s: when.
        faults: that bring it about and end it.
    """

    what: str
    kinects: tuple[int, ...]
    from_s: float
    to_s: float
    faults: tuple[Fault, ...]

    def troubles(self, kinect: int, time_s: float) -> bool:
        """Tell whether a Kinect need not give anything at a time because of it."""
        return kinect in self.kinects and self.from_s <= time_s <= self.to_s + RECOVERY_S


def mishaps(seed: int, seconds: float, kinects: int) -> list[Mishap]:
    """Draw the mishaps of a shift of so many seconds; each kind comes in turn, so that a short shift has them all."""
    rng = np.random.default_rng([seed, 50])
    return list(_drawn(rng, seconds, kinects))


def _drawn(rng: np.random.Generator, seconds: float, kinects: int) -> Iterator[Mishap]:
    at_s = FIRST_S
    while True:
        for what in rng.permutation(SORTS).tolist():
            lasts_s = 0.0 if what == "clock_jump" else float(rng.uniform(2.5, 5.0))
            if at_s + lasts_s + RECOVERY_S > seconds:
                return
            hit = tuple(range(kinects)) if what == "standstill" else (int(rng.integers(kinects)),)
            faults = [fault for kinect in hit for fault in _faults(rng, what, kinect, at_s, lasts_s)]
            yield Mishap(what, hit, at_s, at_s + lasts_s, tuple(faults))
            at_s += lasts_s + RECOVERY_S + float(rng.exponential(3.0))


def _faults(rng: np.random.Generator, what: str, kinect: int, at_s: float, lasts_s: float) -> tuple[Fault, ...]:
    end_s = at_s + lasts_s
    if what == "unplugged":
        return (Fault(at_s, "unplug", kinect), Fault(end_s, "plug_in", kinect))
    if what in ("silence", "standstill"):
        return (Fault(at_s, "silence", kinect, lasts_s),)
    if what == "loss":
        return (Fault(at_s, "lose_every", kinect, int(rng.integers(50, 400))), Fault(end_s, "lose_every", kinect, 0))
    if what == "garbage":
        return (Fault(at_s, "garbage", kinect, int(rng.integers(1, 5))), Fault(end_s, "garbage", kinect, 0))
    if what == "stall":
        return (Fault(at_s, "stall", kinect), Fault(end_s, "stall", kinect, 0))
    if what == "hang":
        hang = Hang.EVENTS if rng.random() < 0.5 else Hang.CONTROL
        # somebody pulls the plug in the end: nothing else helps a real one
        pulled = (Fault(end_s, "unplug", kinect), Fault(end_s + 0.5, "plug_in", kinect))
        return (Fault(at_s, "hang", kinect, hang), *pulled)
    return (Fault(at_s, "clock_jump", kinect, float(rng.choice([-200.0, -3.0, 2.0, 1000.0]))),)
