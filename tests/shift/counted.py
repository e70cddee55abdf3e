"""Which balls were counted, held against which passed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.sensors.turns import VIEWS_NEEDED
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import CountedFruit, Crop, FruitSink
from tests.shift.belt import ENTRY_M, SENSORS_M, SPACING_S, SPEED_M_S, WHOLE_TO_M, Ball, ball

SEEN_FROM_S, SEEN_TO_S = ((end_m - ENTRY_M) / SPEED_M_S for end_m in (-WHOLE_TO_M, WHOLE_TO_M))
"""After its own time, from when on and how long both sensors see a ball whole."""

NEAR_S, NEAR_M = 0.5 * SPACING_S, 0.03


@dataclass(frozen=True, slots=True)
class Count:
    """How the balls were counted.

    Attributes:
        passed: balls that came and went in sight, of which sensors that were well took pictures enough. On a machine
            that starves for seconds none are taken, and nobody can be held to what was never pictured.
        missed: of these, not counted. twice: counted more than once. strange: counted, and no ball.
        volume_error: median relative error of the volumes of those that were counted.
    """

    passed: int
    missed: tuple[int, ...]
    twice: tuple[int, ...]
    strange: int
    volume_error: float


@dataclass(frozen=True, slots=True)
class Sighting:
    """Where a fruit was in the middle of its way, and its volume as measured; reference frame."""

    time_s: float
    x_m: float
    y_m: float
    volume_m3: float


class SeenSink:
    """Keeps fruit in another sink, and of those that are kept no more than is needed to know which balls they were.

    Args:
        sink: keeps fruit.

    Attributes:
        seen: one for each fruit that was kept.
    """

    def __init__(self, sink: FruitSink) -> None:
        self._sink = sink
        self.seen: list[Sighting] = []

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:
        """Keep one fruit, see `FruitSink.commit`."""
        counted = self._sink.commit(lot, fruit, crops)
        middle = fruit.path[len(fruit.path) // 2]
        x_m, y_m, _ = middle.position_m
        self.seen.append(Sighting(middle.time_s, float(x_m), float(y_m), fruit.volume_m3.value))
        return counted


def counted(
    fruit: Sequence[Sighting],
    began_s: float,
    span_s: tuple[float, float],
    seed: int,
    pictured: Sequence[Mapping[int, int]],
) -> Count:
    """Hold what was counted against the balls that passed.

    Args:
        fruit: as counted.
        began_s: of the belt's time, by the line's clock.
        span_s: in the belt's time, when the sensors began and when the shift ended.
        seed: of the belt.
        pictured: of each sensor, how many pictures it took of each ball while it was well, see `Belt`.
    """
    from_s, to_s = span_s
    balls = [ball(number, seed) for number in range(int(to_s / SPACING_S) + 1)]
    found = [_ball_of(one, began_s, balls) for one in fruit]
    often = Counter(one.number for one in found if one is not None)
    passed = [
        one.number
        for one in balls
        if from_s < one.time_s + SEEN_FROM_S
        and one.time_s + SEEN_TO_S < to_s
        and sum(taken.get(one.number, 0) for taken in pictured) >= VIEWS_NEEDED
    ]
    errors = [
        one.volume_m3 / (4 / 3 * np.pi * true.radius_m**3) - 1
        for one, true in zip(fruit, found, strict=True)
        if true is not None
    ]
    return Count(
        len(passed),
        tuple(number for number in passed if not often[number]),
        tuple(number for number, times in often.items() if times > 1),
        sum(one is None for one in found),
        float(np.median(errors)) if errors else float("nan"),
    )


def _ball_of(fruit: Sighting, began_s: float, balls: Sequence[Ball]) -> Ball | None:
    """Return the ball that was where a fruit was counted, when it was there."""
    entered_s = fruit.time_s - began_s - (fruit.x_m + SENSORS_M[0] - ENTRY_M) / SPEED_M_S
    near = [one for one in balls if abs(one.time_s - entered_s) < NEAR_S and abs(one.y_m - fruit.y_m) < NEAR_M]
    return min(near, key=lambda one: abs(one.time_s - entered_s), default=None)
