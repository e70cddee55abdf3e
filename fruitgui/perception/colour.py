"""The colours of fruit as numbers that light changes little or in a known way.

Only pixels well inside a fruit count: neither the belt nor a widened edge mixes
in. Names tell how a feature behaves when the light gets brighter: `chroma_` do
not change, `light_` shift by a constant, `texture_` do not change. The belt
around the fruit serves as a grey card.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8
from fruitgui.perception.limits import DepthLimits, half_of
from fruitgui.perception.pixels import Binned, Pixels, Runs

CHROMA_NAMES = (
    "chroma_red_green_p10",
    "chroma_red_green_p50",
    "chroma_red_green_p90",
    "chroma_blue_green_p10",
    "chroma_blue_green_p50",
    "chroma_blue_green_p90",
    "chroma_red_mean",
    "chroma_red_std",
    "chroma_green_mean",
    "chroma_green_std",
    "chroma_hue_cosine",
    "chroma_hue_sine",
    "chroma_hue_strength",
    "chroma_saturation_mean",
    "chroma_saturation_std",
    "chroma_red_green_to_belt",
    "chroma_blue_green_to_belt",
    "chroma_value_to_belt",
    "chroma_reddish_share",
    "chroma_greenish_share",
)
LIGHT_NAMES = ("light_value_p50",)
TEXTURE_NAMES = ("texture_spread", "texture_dark", "texture_bright", "texture_step", "texture_specular_share")
COLOUR_NAMES = (*CHROMA_NAMES, *LIGHT_NAMES, *TEXTURE_NAMES)

STEP = 2
"""Distance in the calm picture at which steps of brightness are taken: four pixels of the sensor's."""

DARK_LEVEL = 4.0
"""Added to levels before logarithms and ratios: noise in the dark must not look like colour."""

LOGARITHM: F32 = np.log(np.arange(256, dtype=np.float32) + np.float32(DARK_LEVEL))
LOGARITHM.setflags(write=False)


@dataclass(frozen=True, slots=True, eq=False)
class BeltColour:
    """The belt's colour in one picture.

    Attributes:
        red_green, blue_green: logarithms of its channels' ratios.
        value: logarithm of its green level.
    """

    red_green: float
    blue_green: float
    value: float


def calm_picture(color: U8, limits: DepthLimits) -> U8:
    """Return the crop of a picture at half its size, each pixel the mean of six by six: without the grain of the dark.

    Single pixels' shot noise would look like colour: spreads and saturation grow by many of their own spreads
    between 500 and 120 lx. Pixels three from a fruit's edge still see nothing but the fruit.
    """
    half = cv2.resize(color[limits.crop], half_of(*limits.shape)[::-1], interpolation=cv2.INTER_LINEAR)
    return np.asarray(cv2.blur(half, (3, 3)))


def belt_colour(calm: U8, labels: U8, limits: DepthLimits, every: int = 8) -> BeltColour:
    """Return the belt's colour: medians over a coarse grid of the pixels of the crop that can hold fruit and do not.

    Args:
        calm: see `calm_picture`.
        labels: (h, w) of the crop, 0 where no fruit is.
        limits: of the sensor.
        every: spacing of the grid in the calm picture.
    """
    grid = calm[::every, ::every]
    rows, columns = grid.shape[:2]
    reach = slice(None, None, 2 * every)
    bare = (labels[reach, reach] == 0) & (limits.farthest_mm[reach, reach] > 0)
    found, levels = np.flatnonzero(bare[:rows, :columns]), grid.reshape(-1, 3)
    red, green, blue = LOGARITHM.take((levels.take(found, axis=0) if len(found) >= 16 else levels).T)
    ratios = np.stack([red - green, blue - green, green])
    ratios.sort(axis=1)
    below, above = ratios[:, (len(green) - 1) // 2], ratios[:, len(green) // 2]
    return BeltColour(*(0.5 * (below + above)).tolist())


def colour_features(pixels: Pixels, calm: U8, belt: BeltColour) -> F64:
    """Return the colour features (N, 26) of each fruit, from pixels at least three from its edge where it has such.

    Args:
        pixels: of all fruit.
        calm: see `calm_picture`.
        belt: its colour in the same picture.
    """
    enough = pixels.runs.spread(np.minimum(3.0, 0.5 * pixels.deepest_px))
    inner = np.flatnonzero(pixels.edge_px > enough)
    runs = Runs.ending(inner.searchsorted(pixels.runs.starts + pixels.runs.counts))
    place = np.minimum(pixels.row.take(inner) >> 1, calm.shape[0] - 1) * calm.shape[1]
    place += np.minimum(pixels.column.take(inner) >> 1, calm.shape[1] - 1)
    place *= 3
    levels = calm.reshape(-1)
    red, green, blue = (levels.take(place + channel) for channel in range(3))
    beside = np.where(pixels.beside_px.take(inner) > 3.0, levels.take(place + (3 * STEP + 1), mode="clip"), green)
    return _Inner(runs, red, green, blue, beside).features(belt)


class _Inner:
    """Inner pixels of all fruit, sorted by fruit; M pixels."""

    def __init__(self, runs: Runs, red: U8, green: U8, blue: U8, beside: U8) -> None:
        self._runs = runs
        self._red, self._green, self._blue = red.astype(np.float32), green.astype(np.float32), blue.astype(np.float32)
        self._log_green = LOGARITHM.take(green)
        self._red_green = LOGARITHM.take(red) - self._log_green
        self._blue_green = LOGARITHM.take(blue) - self._log_green
        self._step = np.minimum(np.abs(LOGARITHM.take(beside) - self._log_green), np.float32(0.7))

    def _means(self, *values: F32) -> F64:
        return np.asarray(self._runs.sums(*values) / np.maximum(self._runs.counts, 1))

    def features(self, belt: BeltColour) -> F64:
        """Return (N, 26) in the order of `COLOUR_NAMES`."""
        red_green, blue_green, value = self._runs.quantiles(
            [
                Binned.of(self._red_green, -3.0, 3.0),
                Binned.of(self._blue_green, -4.0, 2.0),
                Binned.of(self._log_green, 1.0, 5.6),
            ],
            (0.1, 0.5, 0.9),
        )
        columns = [
            *red_green.T,
            *blue_green.T,
            *self._chromaticity(),
            red_green[:, 1] - belt.red_green,
            blue_green[:, 1] - belt.blue_green,
            value[:, 1] - belt.value,
            *self._means((self._red_green > 0.35).astype(np.float32), (self._red_green < 0.02).astype(np.float32)),
            value[:, 1],
            *self._texture(value),
        ]
        return np.array(columns).T

    def _chromaticity(self) -> list[F64]:
        """Return shares of red and green with their spread, the mean hue as a vector, and saturation."""
        red, green, blue = self._red, self._green, self._blue
        scale = np.float32(1.0) / (red + green + blue + np.float32(3.0 * DARK_LEVEL))
        r, g = (red + np.float32(DARK_LEVEL)) * scale, (green + np.float32(DARK_LEVEL)) * scale
        cosine, sine = (red - (green + blue) * np.float32(0.5)) * scale, (green - blue) * (np.float32(0.866) * scale)
        square = cosine * cosine + sine * sine
        saturation = np.sqrt(square)
        means = self._means(r, r * r, g, g * g, cosine, sine, saturation, square)
        red_std, green_std = _spread(means[0], means[1]), _spread(means[2], means[3])
        chroma = np.maximum(means[6], 1e-6)
        hue = [means[4] / chroma, means[5] / chroma]
        return [means[0], red_std, means[2], green_std, *hue, np.hypot(*hue), means[6], _spread(means[6], means[7])]

    def _texture(self, value: F64) -> list[F64]:
        """Return how uneven brightness is, over the fruit and from pixel to pixel, beside its own mean."""
        green = self._green
        shiny = (self._log_green > self._runs.spread(value[:, 1] + 0.5)).astype(np.float32)
        mean, square, step_mean, shiny_mean = self._means(green, green * green, self._step, shiny)
        spread = _spread(mean, square) / (mean + DARK_LEVEL)
        return [spread, value[:, 0] - value[:, 1], value[:, 2] - value[:, 1], step_mean, shiny_mean]


def _spread(mean: F64, square: F64) -> F64:
    return np.asarray(np.sqrt(np.maximum(square - mean * mean, 0.0)))
