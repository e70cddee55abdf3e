"""What another light, belt or sensor's noise than training's may change of a fruit's axes."""

from __future__ import annotations

import numpy as np

from fruitgui.classification.axes import Axes
from fruitgui.classification.evidence import Evidence
from fruitgui.frame import F64

LIGHT: tuple[dict[str, float], ...] = (
    {  # a lamp elsewhere
        "texture_dark": -0.06, "texture_bright": 0.02, "texture_spread": 0.027, "chroma_value_to_belt": -0.015,
    },
    {"chroma_value_to_belt": 0.05},
    {"chroma_red_green_p50": 0.02},
    {"chroma_blue_green_p50": 0.02},
    {"chroma_red_green_p10": 0.015},
    {"chroma_red_green_p90": 0.015},
    {"chroma_blue_green_p10": 0.02},
    {"chroma_blue_green_p90": 0.02},
    {"chroma_red_std": 0.003},
    {"chroma_green_std": 0.003},
    {"chroma_saturation_std": 0.004},
    {"texture_step": 0.006},
    {"texture_specular_share": 0.01, "texture_bright": 0.02},
)  # fmt: skip
"""Standard deviations of independent changes, each on axes together.

A lamp elsewhere: a ball under a lamp up to 45° from upright and 40–90 % of even light, seen by two opposed sensors from
60°, in logarithms of gamma-encoded levels; √2 times the deviation over 4000 lamps, as training had one too. Brightness
beside the belt: light that falls off by 10 % over the belt's width. Colour beside the belt: a belt that gets dirty by
5 % in one channel. Noise of a small camera at 100 lx is some 6 of 255 values; the calmed picture averages 36 pixels, of
which a colour filter leaves about nine independent: 2 values.
"""

FORM: dict[str, float] = {
    "shape_width_to_length": 0.02,
    "shape_height_to_width": 0.02,
    "shape_height_to_root_area": 0.02,
    "shape_fill": 0.003,
    "shape_solidity": 0.003,
    "shape_ellipse_error": 0.004,
    "shape_tips": 0.006,
    "shape_lopsidedness": 0.014,
    "shape_height_p20": 0.014,
    "shape_height_p50": 0.01,
    "shape_height_p80": 0.006,
    "shape_flat_share": 0.014,
    "shape_sphere_radius": 0.03,
    "shape_sphere_residual": 0.004,
    "size_height": 0.02,
    "size_length": 0.02,
    "size_width": 0.02,
    "size_root_area": 0.02,
    "volume_m3": 0.02,
    "length_m": 0.02,
    "diameter_m": 0.02,
    "perimeter_m": 0.02,
    "height_m": 0.02,
}
"""Standard deviations of what outlines and heights scatter by: a pixel of 50, and the millimetre or so that is left
of depth noise in the mean of some views."""

NEIGHBOUR: dict[str, float] = {
    "shape_width_to_length": 0.075,
    "shape_height_to_width": 0.09,
    "shape_height_to_root_area": 0.075,
    "shape_tips": 0.009,
    "shape_height_p20": 0.03,
    "shape_sphere_radius": 0.09,
    "size_height": 0.06,
    "size_length": 0.06,
    "size_width": 0.06,
    "size_root_area": 0.15,
    "volume_m3": 0.06,
    "height_m": 0.06,
}
"""Standard deviations of what a neighbour that cuts the outline, or hides a foot, does besides: three or four pixels of
50 on one side; some three times what 20 simulated fruit in groups differed by beyond their kind."""


def borne_beside(evidence: Evidence, axes: Axes) -> F64:
    """Return by how much (D,) a fruit may differ besides, as others touch it."""
    if evidence.alone:
        return np.zeros(len(axes.every))
    return np.array([NEIGHBOUR.get(name, 0.0) for name in axes.every])


def borne_changes(axes: Axes) -> F64:
    """Return the standard deviations (C, D) of changes that axes must bear, independent of each other.

    Axes that are named in neither table bear nothing.
    """
    place = {name: at for at, name in enumerate(axes.every)}
    changes = [*LIGHT, *({name: size} for name, size in FORM.items())]
    borne = np.zeros((len(changes), len(place)))
    for row, change in enumerate(changes):
        for name, size in change.items():
            if name in place:
                borne[row, place[name]] = size
    return borne
