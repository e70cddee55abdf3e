"""One fruit as the line leaves it: counted once, with its kind, volume and size, and how sure each is."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.tracking.track import PathPoint


@dataclass(frozen=True, slots=True, eq=False)
class Fruit:
    """A finished, measured and named track.

    Attributes:
        fruit: number, from 1, in the order in which they left.
        kind: a trained kind, or `unknown`.
        kind_probability: of that kind, 0–1.
        size: its lengths corrected by what taught fruit tell, all else as fitted.
        volume_m3: corrected by what reference fruit taught, where they did.
        mass_kg: where the kind's density is known.
        volume_paper_m3: by the source's method, where it was asked for.
        views: how many sensors' frames saw it.
        path: where its centre of volume was, reference frame and clock.
        volume_shared_m3, mass_shared_kg: the parts of their standard deviations that other fruit of the kind share, see
            `measurement.shared`; NaN where they are not known.
    """

    fruit: int
    kind: str
    kind_probability: float
    size: Size
    volume_m3: Quantity
    mass_kg: Quantity | None
    volume_paper_m3: float | None
    views: int
    path: tuple[PathPoint, ...]
    volume_shared_m3: float = nan
    mass_shared_kg: float = nan

    @property
    def first_seen_s(self) -> float:
        """Time of the first view, reference clock."""
        return self.path[0].time_s

    @property
    def last_seen_s(self) -> float:
        """Time of the last view, reference clock."""
        return self.path[-1].time_s
