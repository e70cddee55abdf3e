"""One observation as arrays in the reference frame: what filter, voting and matching work on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fruitgui.errors import InputError
from fruitgui.frame import F64, Bools
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.perception.view import FruitView, Observation
from fruitgui.tracking.field import FieldOfView

LOOK_STD = np.array([0.005, 0.10, 0.03, 0.03, 0.15])
"""How much one fruit's look differs from view to view: height (m), log size, red and green share, log brightness."""

_PAIR_STD = LOOK_STD * np.sqrt(2.0)

CUT_STD_M = 0.02
"""What a centre is off by where the picture's edge cuts the fruit: up to half a radius."""

SPLIT_STD_M = 0.008
"""What a centre is off by where the outline was cut out of a group."""

Centre = Callable[[FruitView], tuple[F64, F64]]
"""Gives a view's measured point (3,) and its covariance (3, 3), optical frame."""


def centre_of(view: FruitView) -> tuple[F64, F64]:
    """Return the estimate of the centre of volume."""
    return view.centre_m, view.centre_covariance_m2


def mean_of(view: FruitView) -> tuple[F64, F64]:
    """Return the mean of the seen points: the source's measurement."""
    return view.mean_m, view.mean_covariance_m2


@dataclass(frozen=True, slots=True, eq=False)
class Measured:
    """The m views of one observation.

    Attributes:
        sensor, time_s: of the observation, reference clock.
        views: the views themselves.
        position_m: (m, 3) centres, reference frame.
        covariance_m2: (m, 3, 3) of the centres as the sensor's errors make it, pose errors left out.
        looks: (m, 5) what tells fruit apart, in the order of `LOOK_STD`.
        size_m: (m,) diameter of the circle of the outline's area.
        whole: (m,) seen whole.
        cut: (m,) cut by the edge of the picture or of the region.
        inside_m: (m,) how far inside the sensor's field.
    """

    sensor: str
    time_s: float
    views: tuple[FruitView, ...]
    position_m: F64
    covariance_m2: F64
    looks: F64
    size_m: F64
    whole: Bools
    cut: Bools
    inside_m: F64

    def __len__(self) -> int:
        return len(self.views)


def measured(observation: Observation, rig: Rig, field: FieldOfView, centre: Centre = centre_of) -> Measured:
    """Return the views of an observation as arrays; views that are not finite are left out.

    Raises:
        InputError: the rig has no such sensor.
    """
    mount = rig.mounts.get(observation.sensor)
    if mount is None:
        raise InputError(
            "unknown_sensor",
            f"The station has no sensor {observation.sensor}.",
            "Leave that sensor out, or calibrate again with it.",
            where=observation.sensor,
            values={"sensor": observation.sensor},
        )
    views, centres, own = _estimates(observation.views, centre)
    position = mount.pose.apply(centres)
    inside_m = field.sensors[observation.sensor].depth_m(position)
    size_m = _sizes_m(views, centres, mount)
    whole = np.array([view.whole for view in views], dtype=bool)
    cut = ~whole & (_at_border(views, mount) | (inside_m < 0.5 * size_m))
    return Measured(
        sensor=observation.sensor,
        time_s=observation.time_s,
        views=views,
        position_m=position,
        covariance_m2=_covariances(own, views, mount, cut),
        looks=_looks(views, size_m),
        size_m=size_m,
        whole=whole,
        cut=cut,
        inside_m=inside_m,
    )


def _estimates(views: tuple[FruitView, ...], centre: Centre) -> tuple[tuple[FruitView, ...], F64, F64]:
    """Return the views whose estimates are finite, their centres (m, 3) and covariances (m, 3, 3)."""
    estimates = [centre(view) for view in views]
    centres = np.array([one[0] for one in estimates], dtype=np.float64).reshape(-1, 3)
    own = np.array([one[1] for one in estimates], dtype=np.float64).reshape(-1, 3, 3)
    finite = np.isfinite(centres).all(axis=1) & np.isfinite(own).all(axis=(1, 2))
    if finite.all():
        return tuple(views), centres, own
    kept = tuple(view for view, fine in zip(views, np.atleast_1d(finite).tolist(), strict=True) if fine)
    return kept, centres[finite], own[finite]


def _sizes_m(views: tuple[FruitView, ...], centres_m: F64, mount: Mount) -> F64:
    """Return the diameters (m,) of circles with the outlines' areas, at the centres' distances."""
    area_px = np.array([view.area_px for view in views], dtype=np.float64)
    focal = np.sqrt(mount.intrinsics.fx * mount.intrinsics.fy)
    return np.asarray(np.sqrt(4.0 * area_px / np.pi) * np.abs(centres_m[:, 2]) / focal)


def _at_border(views: tuple[FruitView, ...], mount: Mount, margin_px: int = 2) -> Bools:
    boxes = np.array([view.box_px for view in views], dtype=np.int64).reshape(-1, 4)
    right, bottom = boxes[:, 0] + boxes[:, 2], boxes[:, 1] + boxes[:, 3]
    near = (boxes[:, 0] <= margin_px) | (boxes[:, 1] <= margin_px)
    far = (right >= mount.intrinsics.width - margin_px) | (bottom >= mount.intrinsics.height - margin_px)
    return np.asarray(near | far)


def _covariances(own: F64, views: tuple[FruitView, ...], mount: Mount, cut: Bools) -> F64:
    R = mount.pose.rotation
    turned = R @ (0.5 * (own + own.transpose(0, 2, 1))) @ R.T
    shared = np.array([view.shared for view in views], dtype=bool)
    extra = 1e-7 + cut * CUT_STD_M**2 + shared * SPLIT_STD_M**2
    turned[:, [0, 1, 2], [0, 1, 2]] += extra[:, None]
    return np.asarray(turned)


def _looks(views: tuple[FruitView, ...], size_m: F64) -> F64:
    """Return (m, 5) of height, log size, red and green share and log brightness of the patch's middle."""
    if not views:
        return np.zeros((0, len(LOOK_STD)))
    middles = np.array([view.patch[12:28:2, 12:28:2] for view in views])
    color = middles.mean(axis=(1, 2), dtype=np.float64) + 1.0
    total = color.sum(axis=1)
    height_m = np.array([view.height_m for view in views])
    share = color[:, :2] / total[:, None]
    return np.column_stack([height_m, np.log(np.maximum(size_m, 1e-3)), share, np.log(total)])


def distances_m(first_m: F64, second_m: F64) -> F64:
    """Return the distances (n, m) of points (n, 3) from points (m, 3)."""
    apart = first_m[:, None] - second_m[None]
    return np.asarray(np.sqrt(np.einsum("nmi,nmi->nm", apart, apart)))


def variances(covariances_m2: F64) -> F64:
    """Return the mean variance per axis of covariances (m, 3, 3), (m,)."""
    return np.asarray(np.einsum("kii->k", covariances_m2) / 3.0)


def look_distance(first: F64, second: F64) -> F64:
    """Return squared distances (n, m) between looks (n, 5) and (m, 5), in standard deviations of one view's."""
    scaled = first[:, None] / _PAIR_STD - second[None] / _PAIR_STD
    return np.asarray(np.einsum("nmk,nmk->nm", scaled, scaled))
