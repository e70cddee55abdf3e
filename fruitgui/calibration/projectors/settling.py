"""How long depth is of no use after a projector was switched on, from several times that it was.

The last pictures of each time tell what steady light gives, and how much one picture differs from the next by itself;
the light has settled with the first picture from which on all are like that. It had settled somewhere between that
picture and the one before, so that picture's time is an upper bound. What is to be waited for is the longest of all
times, and half a picture's period more: the next time falls differently between two pictures. A time whose first
pictures were missed says little of when that was, and does not count.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from fruitgui.calibration.projectors.glimpse import SPREADS, Glimpse, Level

LEAST_TRIALS = 3
LEAST_PICTURES = 15
"""Of one time that the projector was on."""

TAIL = 1 / 3
"""Part of the pictures that counts as steady; a light that settles only there was not seen to be steady."""

MISSED_PICTURES = 1.5
"""Where a time's first picture comes so many later than that of another one, some before it were missed."""

STRAY_AFTER = 5
"""One picture that is unlike the others so many pictures after the last such is a hand that passes, not the light."""

CHANGES_HZ = 0.01
"""Share of the picture by which holes may change in a second of steady light."""

MOVED_MM = 3.0
"""What lies before the sensor was moved between two times, where its readings differ by so much more than by noise."""

ALMOST_BLIND = 0.9


class Refusal(Enum):
    """Why nothing can be told."""

    TOO_FEW = "too_few_pictures"
    BLIND = "sees_nothing"
    MOVED = "scene_moved"
    UNSTEADY = "never_steady"


@dataclass(frozen=True, slots=True, eq=False)
class Settled:
    """How a projector settles.

    Attributes:
        settle_s, discard_frames: what is to be waited for, both.
        steady_s: when it was steady, the latest of all times.
        trials: how often it was switched on and seen from then on.
        steady: what its steady light gives.
    """

    settle_s: float
    discard_frames: int
    steady_s: float
    trials: int
    steady: Level


def settling_of(trials: Sequence[Sequence[Glimpse]]) -> Settled | Refusal:
    """Return how a projector settles, or why that cannot be told.

    Args:
        trials: for each time that it was switched on, its pictures in order; nobody else shone.
    """
    whole = whole_of(trials)
    if len(whole) < LEAST_TRIALS:
        return Refusal.TOO_FEW
    tails = [trial[-round(TAIL * len(trial)) :] for trial in whole]
    levels = [Level.of(tail) for tail in tails]
    if min(level.holes for level in levels) > ALMOST_BLIND:
        return Refusal.BLIND
    apart_mm = [levels[0].moved_mm(level) - levels[0].apart_mm for level in levels[1:]]
    if not np.all(np.isfinite(apart_mm)) or max(apart_mm) > MOVED_MM:
        return Refusal.MOVED
    steady = Level.of([picture for tail in tails for picture in tail])
    if _still_changes(tails, steady.holes_std):
        return Refusal.UNSTEADY
    firsts = [_first_steady(trial, steady) for trial in whole]
    if any(first >= len(trial) - len(tail) for first, trial, tail in zip(firsts, whole, tails, strict=True)):
        return Refusal.UNSTEADY
    pictures = [trial[first] for first, trial in zip(firsts, whole, strict=True)]
    steady_s = max(one.since_s for one in pictures)
    discard = max(one.frames for one in pictures)
    return Settled(steady_s + 0.5 * _period_s(whole), discard, steady_s, len(whole), steady)


def whole_of(trials: Sequence[Sequence[Glimpse]]) -> list[list[Glimpse]]:
    """Return the times that have pictures enough and of which none at their beginning was missed."""
    long = [list(trial) for trial in trials if len(trial) >= LEAST_PICTURES]
    if not long:
        return []
    latest_s = min(trial[0].since_s for trial in long) + MISSED_PICTURES * _period_s(long)
    return [trial for trial in long if trial[0].since_s <= latest_s]


def _period_s(trials: Sequence[Sequence[Glimpse]]) -> float:
    return float(np.median(np.concatenate([np.diff([one.since_s for one in trial]) for trial in trials])))


def _still_changes(tails: Sequence[Sequence[Glimpse]], holes_std: float) -> bool:
    """Tell whether holes still grow or go by so much, from the first to the second half of the steady pictures."""
    rates_hz = []
    for tail in tails:
        half = len(tail) // 2
        first, second = tail[:half], tail[-half:]
        change = np.median([one.holes for one in second]) - np.median([one.holes for one in first])
        rates_hz.append(change / (np.mean([one.since_s for one in second]) - np.mean([one.since_s for one in first])))
    lasts_s = float(np.median([tail[-1].since_s - tail[0].since_s for tail in tails]))
    return abs(float(np.median(rates_hz))) > max(CHANGES_HZ, SPREADS * holes_std / lasts_s)


def _first_steady(trial: Sequence[Glimpse], steady: Level) -> int:
    """Return the number of the picture from which on all are steady, but for a stray one."""
    unlike = [-1, *(number for number, picture in enumerate(trial) if not steady.holds(picture))]
    if len(unlike) > 1 and unlike[-1] - unlike[-2] > STRAY_AFTER:
        unlike.pop()
    return unlike[-1] + 1
