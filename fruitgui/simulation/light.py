"""Light on the line, and how a colour camera answers to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, F64, U8


@dataclass(frozen=True, slots=True)
class Light:
    """The hall's light.

    Attributes:
        lux: on the belt, 100–1000.
        tint: (r, g, b) of the light after white balance, about 1 each.
        direction: unit vector to the main lamp, world frame.
        ambient: share that comes from everywhere.
        slope: relative change of the light per metre in x and y.
        contact: how dark the belt gets beside a body (0–1).
    """

    lux: float = 500.0
    tint: tuple[float, float, float] = (1.0, 1.0, 1.0)
    direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    ambient: float = 0.6
    slope: tuple[float, float] = (0.0, 0.0)
    contact: float = 0.45

    def on(self, normal: F32) -> F32:
        """Return the relative light on surfaces with unit normals (…, 3)."""
        lit = np.clip(normal @ np.array(self.direction, dtype=np.float32), 0, 1)
        sky = np.float32(0.5 * self.ambient) * (1 + normal[..., 2])
        return np.asarray(sky + np.float32(1 - self.ambient) * lit, dtype=np.float32)

    def over(self, place_m: F32) -> F32:
        """Return the relative light at world places (…, 2)."""
        return np.clip(1 + place_m @ np.array(self.slope, dtype=np.float32), 0.5, 1.5).astype(np.float32)


def make_light(rng: Generator, lux: float | None = None) -> Light:
    """Return random light of a hall; `lux` is drawn between 100 and 1000 (evenly in its logarithm) where not given."""
    warm = rng.normal(0, 0.06)
    tint = np.array([1 + warm, 1.0, 1 - warm]) * (1 + rng.normal(0, 0.015, 3))
    tilt, around = rng.uniform(0, 0.7), rng.uniform(0, 2 * np.pi)
    lamp = (np.sin(tilt) * np.cos(around), np.sin(tilt) * np.sin(around), np.cos(tilt))
    drawn = float(np.exp(rng.uniform(np.log(100), np.log(1000)))) if lux is None else lux
    return Light(
        drawn,
        (float(tint[0]), float(tint[1]), float(tint[2])),
        (float(lamp[0]), float(lamp[1]), float(lamp[2])),
        float(rng.uniform(0.45, 0.8)),
        (float(rng.normal(0, 0.08)), float(rng.normal(0, 0.08))),
        float(rng.uniform(0.25, 0.55)),
    )


@dataclass(frozen=True, slots=True)
class ColorModel:
    """How one colour camera answers.

    Attributes:
        electrons_per_lux: collected by a white pixel per lux at the longest exposure.
        full_well: electrons at which a pixel is full; exposure is shortened above it.
        read_noise: electrons.
        target: mean value (0–1, linear) that the exposure aims at.
        compliance: how much of a change of light is left in the picture (0 none, 1 all), relative to 300 lux.
        vignetting: loss of light in the corner.
        blur_px: of the lens and the colour filter.
        balance: (r, g, b) gains of this camera's white balance.
        noise: factor of all noise; 0 is none.
    """

    electrons_per_lux: float = 18.0
    full_well: float = 8000.0
    read_noise: float = 14.0
    target: float = 0.20
    compliance: float = 0.15
    vignetting: float = 0.15
    blur_px: float = 0.6
    balance: tuple[float, float, float] = (1.0, 1.0, 1.0)
    noise: float = 1.0


_LEVELS = 4096


class ColorResponse:
    """A camera's tables for one light."""

    def __init__(self, model: ColorModel, light: Light) -> None:
        self._model = model
        self._light = light
        level = np.arange(_LEVELS) / (_LEVELS - 1)
        self._value = (255 * level ** (1 / 2.2)).astype(np.float32)
        self._slope = 255 / 2.2 * np.maximum(level, 4e-3) ** (1 / 2.2 - 1)
        self._white_electrons = min(model.electrons_per_lux * light.lux, model.full_well)

    def expose(self, radiance: F32, noise: F32) -> U8:
        """Return the picture (H, W, 3) of linear radiances (reflectance × relative light) with standard normal `noise`."""
        model = self._model
        mean = max(float(radiance[::8, ::8].mean()), 1e-3)
        gain = model.target / mean * (self._light.lux / 300) ** model.compliance
        index = radiance * np.float32(gain * (_LEVELS - 1))
        np.minimum(index, np.float32(_LEVELS - 1), out=index)
        level = index.astype(np.uint16)
        picture = self._value[level]
        if model.noise:
            picture += self._noise_table(gain)[level] * noise
        np.clip(picture, 0, 255, out=picture)
        return picture.astype(np.uint8)

    def _noise_table(self, gain: float) -> F32:
        """Return the noise in output values per level: shot noise and read noise, through gain and gamma."""
        electrons = np.arange(_LEVELS) / (_LEVELS - 1) / gain * self._white_electrons
        sigma = np.sqrt(electrons + self._model.read_noise**2) / self._white_electrons * gain
        return np.asarray(self._model.noise * sigma * self._slope, dtype=np.float32)


def vignette(radius2: F32, model: ColorModel) -> F32:
    """Return the relative light per pixel: `radius2` (H, W) is 1 in the corner."""
    return np.asarray(1 - np.float32(model.vignetting) * radius2, dtype=np.float32)


def gains(light: Light, model: ColorModel) -> F64:
    """Return the colour gains (3,) of light and camera together."""
    return np.array(light.tint) * np.array(model.balance)
