"""Where sensors stand: by hand, so never quite the same twice."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from fruitgui.errors import InputError
from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector

LAYOUTS = ("single", "opposed", "chain", "ring", "scattered", "disconnected")
"""Names that `placements` knows."""

USUAL_HEIGHT_M = (0.75, 1.25)
"""Heights of sensors above the belt on a line like the source's: about 1 m from the fruit."""

VIEW_SHARE = 1.1
"""Width of a Kinect's depth picture over its distance (640 / 580)."""


def look_at(position_m: F64, target_m: F64, roll_rad: float = 0.0) -> Pose:
    """Return the pose of a camera at a world position that looks at a target, turned by `roll_rad` about its axis."""
    forward = target_m - position_m
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, np.array([0.0, 0.0, 1.0]))
    if np.linalg.norm(right) < 1e-6:
        right = np.array([1.0, 0.0, 0.0])
    right = right / np.linalg.norm(right)
    level = np.stack([right, np.cross(forward, right), forward], axis=1)
    return Pose(level @ rotation_from_vector(np.array([0.0, 0.0, roll_rad])), np.asarray(position_m, dtype=np.float64))


def placements(
    layout: str, count: int, rng: Generator, height_m: tuple[float, float] = USUAL_HEIGHT_M
) -> tuple[Pose, ...]:
    """Return the sensors' poses into the world for a layout.

    Args:
        layout: one of `LAYOUTS`; opposed is two, chain three or more, ring four or more,
            scattered any number, each at any heading and turned any way about its axis.
        count: how many sensors, 0 for the layout's own number.
        rng: the source of chance.
        height_m: range of the sensors' heights above the belt.

    Raises:
        InputError: no such layout.
    """
    if layout == "single":
        return (_beside(rng, rng.uniform(0, 2 * np.pi), (0.0, 0.45), np.zeros(2), height_m),)
    if layout == "opposed":
        return _opposed(rng, np.zeros(2), height_m)
    if layout == "chain":
        return _chain(rng, count or 3, height_m)
    if layout == "ring":
        return _ring(rng, count or 4, height_m)
    if layout == "scattered":
        return tuple(_anyhow(rng, height_m) for _ in range(count or 4))
    if layout == "disconnected":
        return (
            *_opposed(rng, np.zeros(2), height_m),
            *_opposed(rng, np.array([rng.uniform(3.0, 4.0), 0.0]), height_m),
        )[: count or 3]
    raise InputError("bad_layout", f"There is no layout '{layout}'.", f"Use one of {', '.join(LAYOUTS)}.")


def _opposed(rng: Generator, middle: F64, height_m: tuple[float, float]) -> tuple[Pose, ...]:
    """Two sensors on opposite sides of the belt."""
    side = rng.choice([-1.0, 1.0])
    return tuple(
        _beside(rng, heading + rng.normal(0, 0.15), (0.35, 0.65), middle, height_m)
        for heading in (side * np.pi / 2, -side * np.pi / 2)
    )


def _chain(rng: Generator, count: int, height_m: tuple[float, float]) -> tuple[Pose, ...]:
    """Sensors along the belt; each overlaps with its neighbours, the ends do not see the same place."""
    high_m = rng.uniform(*height_m)
    spacing_m = rng.uniform(0.50, 0.60) * VIEW_SHARE * high_m
    poses = []
    for number in range(count):
        middle = np.array([(number - (count - 1) / 2) * spacing_m, 0.0])
        heading = rng.choice([-1.0, 1.0]) * np.pi / 2 + rng.normal(0, 0.15)
        poses.append(_beside(rng, heading, (0.1, 0.5), middle, (0.95 * high_m, 1.05 * high_m), 0.08))
    order = [count // 2, *(number for number in range(count) if number != count // 2)]
    return tuple(poses[number] for number in (order if rng.random() < 0.5 else range(count)))


def _ring(rng: Generator, count: int, height_m: tuple[float, float]) -> tuple[Pose, ...]:
    """Sensors around the middle."""
    first = rng.uniform(0, 2 * np.pi)
    headings = first + 2 * np.pi * np.arange(count) / count
    return tuple(
        _beside(rng, heading + rng.normal(0, 0.12), (0.35, 0.7), np.zeros(2), height_m) for heading in headings
    )


def _anyhow(rng: Generator, height_m: tuple[float, float]) -> Pose:
    """A sensor held somehow: any heading, up to 45° off the vertical, turned any way about its axis."""
    heading, off = rng.uniform(0, 2 * np.pi), rng.uniform(0.0, np.pi / 4)
    height = rng.uniform(*height_m)
    away = height * np.tan(off) * np.array([np.cos(heading), np.sin(heading)])
    target = np.array([*rng.normal(0, 0.08, 2), 0.0])
    return look_at(target + np.array([*away, height]), target, rng.uniform(-np.pi, np.pi))


def _beside(
    rng: Generator, heading_rad: float, away_m: tuple[float, float], middle: F64,
    height_m: tuple[float, float], roll_std_rad: float = 0.12,
) -> Pose:  # fmt: skip
    """A sensor that stands `away_m` from a place on the belt, in direction `heading_rad`, and looks at it."""
    away, height = rng.uniform(*away_m), rng.uniform(*height_m)
    place = middle + away * np.array([np.cos(heading_rad), np.sin(heading_rad)])
    target = middle + rng.normal(0, 0.04, 2)
    return look_at(np.array([*place, height]), np.array([*target, 0.0]), rng.normal(0, roll_std_rad))
