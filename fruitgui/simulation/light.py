"""Light on the line, and how a colour camera answers to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, F64, U8

MIRROR_SHARPNESS = 40.0
"""Exponent of the mirror image: about 10° wide, waxed skin under a large lamp."""

TONE = 2.0
"""Exponent of the camera's tone curve: values go with the square root of light, close to sRGB's curve."""


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
        lit = np.maximum(normal @ np.array(self.direction, dtype=np.float32), 0)
        sky = np.float32(0.5 * self.ambient) * (1 + normal[..., 2])
        return np.asarray(sky + np.float32(1 - self.ambient) * lit, dtype=np.float32)

    def over(self, place_m: F32) -> F32:
        """Return the relative light at world places (…, 2)."""
        return np.clip(1 + place_m @ np.array(self.slope, dtype=np.float32), 0.5, 1.5).astype(np.float32)

    def mirrored(self, normal: F32, toward: F64) -> F32:
        """Return the lamp's mirror image on unit normals (N, 3) seen from direction `toward` (Blinn 1977)."""
        half = np.array(self.direction) + toward
        half /= np.linalg.norm(half)
        return np.asarray(np.maximum(normal @ half.astype(np.float32), 0) ** MIRROR_SHARPNESS, dtype=np.float32)


def make_light(rng: Generator, lux: float | None = None) -> Light:
    """Return random light of a hall; `lux` is drawn between 100 and 1000 (evenly in its logarithm) where not given."""
    warm = rng.normal(0, 0.06)
    tint = np.array([1 + warm, 1.0, 1 - warm]) * (1 + rng.normal(0, 0.015, 3))
    tilt, around = rng.uniform(0, 0.7), rng.uniform(0, 2 * np.pi)
    lamp = (np.sin(tilt) * np.cos(around), np.sin(tilt) * np.sin(around), np.cos(tilt))
    drawn = float(np.exp(rng.uniform(np.log(100), np.log(1000))))
    return Light(
        drawn if lux is None else lux,
        (float(tint[0]), float(tint[1]), float(tint[2])),
        (float(lamp[0]), float(lamp[1]), float(lamp[2])),
        float(rng.uniform(0.45, 0.8)),
        (float(rng.normal(0, 0.08)), float(rng.normal(0, 0.08))),
        float(rng.uniform(0.25, 0.55)),
    )


@dataclass(frozen=True, slots=True)
class ColorModel:
    """How one colour camera answers.

    Light makes electrons (shot noise is their square root), reading adds noise
    of its own, gain lifts both to the wanted brightness: dark scenes are noisy.

    Attributes:
        electrons_per_lux: collected by a white pixel per lux at the longest exposure.
        full_well: electrons at which a pixel is full; the exposure is shortened above it.
        read_noise: electrons.
        target: mean light (0–1, linear) that the exposure aims at.
        compliance: how much of a change of light is left in the picture (0 none, 1 all), relative to 300 lux.
        vignetting: loss of light in the corner.
        blur_px: of the lens and the colour filter.
        balance: (r, g, b) gains of this camera's white balance.
        crosstalk: share of each colour that comes from the mean of all (filters overlap).
        exposure_s: longest exposure; moving things are blurred along their way.
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
    crosstalk: float = 0.08
    exposure_s: float = 0.02
    noise: float = 1.0

    def exposure_at_s(self, lux: float) -> float:
        """Return the exposure under a light: shorter where the pixels would be full."""
        return self.exposure_s * min(self.full_well / (self.electrons_per_lux * lux), 1.0)


def expose(radiance: F32, model: ColorModel, lux: float, grain: F32) -> U8:
    """Return the picture (H, W, 3) of linear light (H, W, 3).

    Args:
        radiance: reflectance × relative light; white in full light is 1.
        model: the camera.
        lux: the hall's light.
        grain: standard normal noise of the same shape.
    """
    import cv2

    gain = model.target / max(float(radiance[::8, ::8].mean()), 1e-3) * (lux / 300) ** model.compliance
    if model.noise:
        white = min(model.electrons_per_lux * lux, model.full_well)
        variance = cv2.addWeighted(radiance, 1 / white, radiance, 0.0, (model.read_noise / white) ** 2)
        noise = cv2.multiply(cv2.sqrt(variance), grain, scale=model.noise)
        radiance = np.maximum(cv2.add(radiance, noise, dst=noise), np.float32(0), out=noise)
    picture: U8 = cv2.convertScaleAbs(cv2.sqrt(radiance), alpha=255 * gain**0.5)
    return picture


def vignette(radius2: F32, model: ColorModel) -> F32:
    """Return the relative light per pixel: `radius2` (H, W) is 1 in the corner."""
    return np.asarray(1 - np.float32(model.vignetting) * radius2, dtype=np.float32)


def mixing(light: Light, model: ColorModel) -> F32:
    """Return the matrix (3, 3) from reflectance (row vectors, on the left) to the camera's colours."""
    overlap = (1 - model.crosstalk) * np.eye(3) + model.crosstalk / 3
    return np.asarray(np.array(light.tint)[:, None] * overlap * np.array(model.balance), dtype=np.float32)


def linear(srgb: F64) -> F32:
    """Return linear light of picture values 0–1 (the inverse of the tone curve)."""
    return np.asarray(np.clip(srgb, 0, 1) ** TONE, dtype=np.float32)
