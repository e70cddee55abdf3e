"""Which part of the belt nobody sees, or not often enough, while sensors are away or give too few pictures."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from math import floor

import cv2
import numpy as np

from fruitgui.frame import F64, U8, Bools
from fruitgui.sensors.turns import VIEWS_NEEDED

CELL_M = 0.005
LEAST_WAY_M = 0.10
"""A fruit is seen on its lane by a sensor that sees so much of its way: less shows none whole."""

LEAST_WIDTH_M = 0.02
"""Narrower than any fruit: not worth a word."""

SUB_PX_BITS = 4


@dataclass(frozen=True, slots=True)
class Blind:
    """What is not seen, or not often enough.

    Attributes:
        sensors: those that are away, or give too few pictures, by the station's ids.
        lanes_m: stripes along the belt on which fruit pass unseen, each (from, to) in metres from the belt's right
            edge as seen by all sensors together, looking the way it runs; None while that way is not known.
        width_m: of the belt, from that edge on; None likewise.
        share: of the area that all sensors see together, what nobody sees now, 0–1.
    """

    sensors: tuple[str, ...]
    lanes_m: tuple[tuple[float, float], ...] | None
    width_m: float | None
    share: float

    @property
    def loses_fruit(self) -> bool:
        """Whether fruit can pass unseen."""
        return self.share > 0.0 if self.lanes_m is None else bool(self.lanes_m)

    @property
    def sides(self) -> tuple[str, ...]:
        """Where each lane lies: `whole`, `left`, `middle` or `right`."""
        return tuple(_side(lane_m, self.width_m or 1.0) for lane_m in self.lanes_m or ())


def blind_part(footprints_m: Mapping[str, F64], away: Collection[str], *, along: bool) -> Blind:
    """Return what nobody sees while some sensors are away.

    Args:
        footprints_m: by sensor, the convex polygon (K, 2) that it sees, on the belt from above.
        away: sensors that give nothing.
        along: x runs with the belt and y to the left of it; otherwise no lanes can be told.
    """
    names = tuple(name for name in footprints_m if name in away)
    seen_by = {name: polygon for name, polygon in footprints_m.items() if len(polygon) >= 3}
    if not seen_by:
        return Blind(names, () if along else None, 0.0 if along else None, 0.0)
    corners = np.concatenate(list(seen_by.values()))
    low, high = corners.min(axis=0), corners.max(axis=0)
    everywhere = _drawn(list(seen_by.values()), low, high)
    now = _drawn([polygon for name, polygon in seen_by.items() if name not in away], low, high)
    share = float((everywhere & ~now & 1).sum() / max(everywhere.sum(), 1))
    if not along:
        return Blind(names, None, None, share)
    enough = LEAST_WAY_M / CELL_M
    blind = (everywhere.sum(axis=1) >= enough) & (now.sum(axis=1) < enough)
    width_m = float(high[1] - low[1])
    lanes = [(begin * CELL_M, min(end * CELL_M, width_m)) for begin, end in _runs(blind)]
    wide = tuple(lane_m for lane_m in lanes if lane_m[1] - lane_m[0] >= LEAST_WIDTH_M)
    return Blind(names, wide, width_m, share)


def _drawn(polygons: list[F64], low: F64, high: F64) -> U8:
    """Return a picture (y, x) of the belt, a cell for each 5 mm, 1 where any of the polygons is."""
    columns, rows = (np.ceil((high - low) / CELL_M)).astype(int) + 1
    picture: U8 = np.zeros((rows, columns), np.uint8)
    for polygon in polygons:
        points = np.rint((polygon - low) / CELL_M * 2**SUB_PX_BITS).astype(np.int32)
        cv2.fillConvexPoly(picture, points, 1, shift=SUB_PX_BITS)
    return picture


def _runs(true: Bools) -> list[tuple[int, int]]:
    """Return where a row of truths is true, as (first, one past the last)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], true, [False]]).astype(np.int8)))
    return [(int(begin), int(end)) for begin, end in edges.reshape(-1, 2)]


def _side(lane_m: tuple[float, float], width_m: float) -> str:
    begin, end = lane_m[0] / width_m, lane_m[1] / width_m
    if end - begin > 0.9:
        return "whole"
    middle = (begin + end) / 2.0
    if begin < 0.1 and middle < 0.45:
        return "right"
    if end > 0.9 and middle > 0.55:
        return "left"
    return "right" if middle < 1.0 / 3.0 else "left" if middle > 2.0 / 3.0 else "middle"


def blind_words(blind: Blind) -> str:
    """Return it in English, for logs and for programs."""
    names = ", ".join(blind.sensors)
    begin = f"Sensor {names} gives nothing" if len(blind.sensors) == 1 else f"Sensors {names} give nothing"
    if not blind.loses_fruit:
        return f"{begin}; every part of the belt is seen by another, so fruit are counted, but measured less surely."
    return f"{begin}; {_parts(blind)} is seen by no sensor, and fruit there are not counted."


def sparse_words(blind: Blind) -> str:
    """Return likewise that sensors give too few pictures for the belt's speed."""
    gives = "gives" if len(blind.sensors) == 1 else "give"
    names = ("Sensor " if len(blind.sensors) == 1 else "Sensors ") + ", ".join(blind.sensors)
    begin = f"{names} {gives} fewer than {VIEWS_NEEDED} pictures of a fruit at this speed of the belt"
    if not blind.loses_fruit:
        return f"{begin}; every part of it is seen by another, so fruit are counted, but measured less surely."
    return f"{begin}; {_parts(blind)} is seen by no other sensor, and fruit there may be missed."


def _parts(blind: Blind) -> str:
    if blind.lanes_m is None or blind.width_m is None:
        percent = max(floor(100 * blind.share), 1)  # what is not the whole is never called so
        return f"{percent}% of the belt"
    return ", ".join(
        "the whole belt"
        if side == "whole"
        else f"the {side} part of the belt ({lane[0]:.2f}–{lane[1]:.2f} m from its right edge, looking the way it runs)"
        for side, lane in zip(blind.sides, blind.lanes_m, strict=True)
    )
