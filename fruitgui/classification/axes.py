"""Features as they are compared: colours beside the belt's, spreads about their middle, sizes beside one of them.

The belt is seen under the same light by the same camera, so it serves as a grey card: exposure and colour of the light
cancel. And few fruit teach correlations poorly, so what goes together is split into one axis for what is common (how
large, which colour) and others for what differs.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fruitgui.classification.evidence import FeatureNames
from fruitgui.frame import F32, F64, Bools, Ints
from fruitgui.perception.colour import DARK_LEVEL

BELT_LEVEL = 140.0
"""The level, of 255, that the belt gets in every channel."""

_LEAST_LEVEL = 1.0
_SMALLEST = 1e-12
_UNITS = ("_m", "_m2", "_m3")
_SHARES = ("p10", "p50", "p90")
_RED, _BLUE = (tuple(f"chroma_{name}_green_{share}" for share in _SHARES) for name in ("red", "blue"))
_GREEN = "light_value_p50"
_RED_TO_BELT, _BLUE_TO_BELT, _TO_BELT = (f"chroma_{name}_to_belt" for name in ("red_green", "blue_green", "value"))
_OF_THE_LIGHT = frozenset(
    {
        _GREEN, _RED_TO_BELT, _BLUE_TO_BELT, "chroma_red_mean", "chroma_green_mean", "chroma_hue_cosine",
        "chroma_hue_sine", "chroma_hue_strength", "chroma_saturation_mean", "chroma_reddish_share",
        "chroma_greenish_share",
    }
)  # fmt: skip
"""Features that move with the colour of the light and tell nothing that colours beside the belt's do not."""

_SIZE = "size_root_area"
_VOLUME = "volume_m3"
_COLOURS = ("chroma_", "light_", "texture_", "colour_")
_BLENDS = ("chroma_red_std", "chroma_green_std", "chroma_saturation_std")
_OUTLINE = frozenset(
    {
        "shape_fill", "shape_solidity", "shape_ellipse_error", "shape_lopsidedness",
        "length_m", "diameter_m", "perimeter_m", *_BLENDS,
    }
)  # fmt: skip
"""What a straight cut through an outline changes by more than fruit of a kind differ, and callipers of all points
together: they reach into whatever some frame did not part."""


@dataclass(frozen=True, slots=True)
class Axes:
    """The axes into which features are turned.

    Attributes:
        view: names of those of one view; each is named after the feature that it is made of.
        fruit: names of those of the whole fruit.
        kept: which view features become axes.
        by_belt: whether the colours can be compared with the belt's.
    """

    view: tuple[str, ...]
    fruit: tuple[str, ...]
    kept: tuple[int, ...]
    by_belt: bool

    @property
    def every(self) -> tuple[str, ...]:
        """The names of a fruit's axes: its views', then its own."""
        return (*self.view, *self.fruit)

    @property
    def outline(self) -> Ints:
        """Which axes say something only of an outline that no neighbour cuts, or whose edges blend with none."""
        return np.array([at for at, name in enumerate(self.every) if name in _OUTLINE], dtype=np.intp)

    @property
    def lone(self) -> Ints:
        """Which axes say something only of what is seen whole: shapes, sizes, and colours that blend."""
        every = enumerate(self.every)
        return np.array(
            [at for at, name in every if not name.startswith(_COLOURS) or name in _BLENDS], dtype=np.intp
        )  # fmt: skip


@lru_cache(maxsize=8)
def axes_of(names: FeatureNames) -> Axes:
    """Return the axes that features of these names are turned into."""
    by_belt = {*_RED, *_BLUE, _GREEN, _RED_TO_BELT, _BLUE_TO_BELT, _TO_BELT} <= {*names.view}
    kept = tuple(at for at, name in enumerate(names.view) if not (by_belt and name in _OF_THE_LIGHT))
    return Axes(tuple(names.view[at] for at in kept), names.fruit, kept, by_belt)


def view_axes(features: F32 | F64, names: FeatureNames) -> F64:
    """Return view features (n, F) as axes (n, A)."""
    axes, place = axes_of(names), {name: at for at, name in enumerate(names.view)}
    values = _by_ratio(features, names.view)
    if axes.by_belt:
        _beside_the_belt(values, place)
    if _SIZE in place:
        for name, at in place.items():
            if name.startswith("size_") and name != _SIZE:
                values[:, at] -= values[:, place[_SIZE]]
    return values[:, list(axes.kept)]


def fruit_axes(features: F64, mean: F64, names: FeatureNames) -> F64:
    """Return the features (G,) of a whole fruit as axes; `mean` (A,) has those of its views."""
    values, view = _by_ratio(features, names.fruit), axes_of(names).view
    for at, name in enumerate(names.fruit):
        if name == _VOLUME:
            values[at] /= 3.0
        if _SIZE in view and name.endswith(_UNITS):
            values[at] -= mean[view.index(_SIZE)]
    return values


def _beside_the_belt(values: F64, place: dict[str, int]) -> None:
    """Turn the colours of views into those under a light and exposure that make the belt grey, in place.

    Features hold logarithms of levels plus `DARK_LEVEL`, so levels are worked out, scaled and packed again.
    """
    green_log = values[:, place[_GREEN]].copy()
    belt_log = green_log - values[:, place[_TO_BELT]]
    green = _level(green_log) * BELT_LEVEL / _level(belt_log)
    green_now = np.log(green + DARK_LEVEL)
    for ratios, to_belt in ((_RED, _RED_TO_BELT), (_BLUE, _BLUE_TO_BELT)):
        low, middle, high = (place[name] for name in ratios)
        belt = _level(belt_log + values[:, middle] - values[:, place[to_belt]])
        for at in (low, middle, high):
            values[:, at] = np.log(_level(green_log + values[:, at]) * BELT_LEVEL / belt + DARK_LEVEL) - green_now
        values[:, low] -= values[:, middle]
        values[:, high] -= values[:, middle]
    values[:, place[_TO_BELT]] = green_now - np.log(BELT_LEVEL + DARK_LEVEL)


def _level(logarithm: F64) -> F64:
    return np.asarray(np.maximum(np.exp(logarithm) - DARK_LEVEL, _LEAST_LEVEL))


def _by_ratio(values: F32 | F64, names: tuple[str, ...]) -> F64:
    """Return the values (…, F) with sizes in units replaced by their logarithm; NaN stays NaN."""
    sizes: Bools = np.array([name.endswith(_UNITS) for name in names], dtype=bool)
    scaled = np.array(values, dtype=np.float64)
    scaled[..., sizes] = np.log(np.maximum(scaled[..., sizes], _SMALLEST))
    return scaled
