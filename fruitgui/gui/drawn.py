"""What screens draw of fruit, as plain data: made by presenters, painted by widgets."""

from __future__ import annotations

from dataclasses import dataclass

from fruitgui.frame import F32, F64, U8
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.station.live.state import Spread


@dataclass(frozen=True, slots=True, eq=False)
class DrawnFruit:
    """One fruit in a sensor's picture, pixels of that picture.

    Attributes:
        number: of its track.
        mark: of its kind so far.
        outline_px: (K, 2).
        words: lines for a label, the most important first; empty draws none.
        ellipse: where its centre is with 95 %; None where that is not known.
        trail_px: (M, 2) where it was, the oldest first.
    """

    number: int
    mark: KindMark
    outline_px: F32
    words: tuple[str, ...]
    ellipse: Spread | None
    trail_px: F64


@dataclass(frozen=True, slots=True, eq=False)
class DrawnPicture:
    """A sensor's picture with the fruit in it.

    Attributes:
        sensor: the sensor's name.
        color: (h, w, 3) uint8 RGB.
        fruit: in it.
        health: `good`, `warn` or `bad`. words: on the sensor: rate, or what is wrong.
        stale: in words, since when no newer picture came; empty for a picture of now.
    """

    sensor: str
    color: U8
    fruit: tuple[DrawnFruit, ...]
    health: str
    words: str
    stale: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class MappedFruit:
    """One fruit on the belt from above, metres along and across the belt.

    Attributes:
        number, mark: of its track, and of its kind so far.
        radius_m: half its length.
        ellipse: where its centre is with 95 %, metres.
        trail_m: (M, 2) where it was, the oldest first.
    """

    number: int
    mark: KindMark
    radius_m: float
    ellipse: Spread
    trail_m: F64


@dataclass(frozen=True, slots=True, eq=False)
class BeltMap:
    """The belt from above; x along its motion, y across, metres.

    Attributes:
        footprints_m: by sensor, the polygon (K, 2) of the belt that it sees.
        blind: sensors that give nothing now.
        fruit: on it.
        speed_m_s: of the belt; None where not known yet.
        words: what nobody sees of it; empty where all is seen. lost: fruit may pass unseen.
    """

    footprints_m: dict[str, F64]
    blind: frozenset[str]
    fruit: tuple[MappedFruit, ...]
    speed_m_s: float | None
    words: str = ""
    lost: bool = False


@dataclass(frozen=True, slots=True)
class KindLine:
    """What is shown of one kind.

    Attributes:
        mark: of the kind. name: as people read it.
        count: fruit of it in this lot.
        volume_ml: mean volume. volume_half_ml: half the width of its 95 % interval. None before the first.
        spread_ml: standard deviation between its fruit; None before the second.
        total_l: all volumes together. mass_kg: all masses together, None where the density is not known.
        per_minute: over the last minutes, to the whole piece that is shown: what looks the same is not drawn again.
    """

    mark: KindMark
    name: str
    count: int
    volume_ml: float | None
    volume_half_ml: float | None
    spread_ml: float | None
    total_l: float
    mass_kg: float | None
    per_minute: int


@dataclass(frozen=True, slots=True, eq=False)
class LastFruit:
    """One fruit that was counted just now.

    Attributes:
        key: of its record. number: within the lot.
        mark, name: of its kind. probability: of that kind, 0–1.
        volume_ml, volume_std_ml: its volume.
        picture: coded (JPEG or PNG), or None where there is none.
    """

    key: int
    number: int
    mark: KindMark
    name: str
    probability: float
    volume_ml: float
    volume_std_ml: float
    picture: bytes | None
