"""Where finished fruit go: what comes back from a sink is durable, and only then may be shown as counted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from fruitgui.errors import WorldError
from fruitgui.station.fruit import Fruit

Content = Literal["colour", "depth", "outline"]
"""What a crop shows."""

Coding = Literal["jpeg", "png"]
"""How a crop's picture is coded."""


@dataclass(frozen=True, slots=True, eq=False)
class Crop:
    """The picture of one view of one fruit, cut out and coded.

    Attributes:
        number: of the view among those kept of this fruit, from 0; one number for all contents of a view.
        content: what it shows.
        sensor: the sensor's id.
        time_s: capture time of its frame, in that sensor's own clock.
        left_px, top_px: where its upper left corner lies in the sensor's colour image.
        coding: of `data`.
        data: the coded picture.
    """

    number: int
    content: Content
    sensor: str
    time_s: float
    left_px: int
    top_px: int
    coding: Coding
    data: bytes


@dataclass(frozen=True, slots=True, eq=False)
class CountedFruit:
    """A fruit that is in the store for good.

    Attributes:
        key: of the fruit, unique in the store.
        lot: key of the lot.
        number: within the lot, from 1, without gaps, whatever crashed in between.
        fruit: as the line gave it.
        crops_problem: why its crops could not be kept; the fruit counts all the same.
    """

    key: int
    lot: int
    number: int
    fruit: Fruit
    crops_problem: WorldError | None = None


class FruitSink(Protocol):
    """Takes finished fruit."""

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:
        """Keep one fruit; when this returns, neither a crash nor a power cut loses it.

        Raises:
            WorldError: it could not be kept (disk full, read-only, locked, damaged); nothing of it was.
            InputError: there is no such lot.
        """
        ...
