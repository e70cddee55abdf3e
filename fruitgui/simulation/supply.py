"""Fruit that keep coming along a line, batch after batch, each batch from its own seed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from fruitgui.simulation.body import Body
from fruitgui.simulation.device import Device
from fruitgui.simulation.fruit import KINDS
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.packing import clusters, stream
from fruitgui.simulation.scenes import sight_of
from fruitgui.simulation.setting import Conditions, Setting, make_setting
from fruitgui.simulation.simulation import TrueFruit, measured_on_mesh
from fruitgui.simulation.stock import made_restless, mixed

BATCH = 12
BEFORE_SIGHT_M = 0.25
"""The first fruit start so far before the sensors' sight; what is as far behind it has left."""

LUX = 500.0

SCALE_ERROR, OFFSET_M, RADIAL_ERROR = 0.02, 0.02, 0.008
"""Devices as sold differ by up to so much in scale and offset, and bend planes by so much in the picture's corners."""


@dataclass(frozen=True, slots=True)
class LineOptions:
    """A simulated rig and the line that runs below it.

    Attributes:
        rig_seed: decides where sensors stand, how each errs, belt and rails.
        seed: decides the fruit, their places, their own motion and the noise.
        layout, sensors: see `layouts.placements`.
        rate_hz: captures per second of each sensor.
        speed_m_s: of the belt.
        per_metre: pieces per metre of belt.
        kinds: drawn in turn.
        foreign: share of the pieces that are no fruit.
        touching: share of the pieces that touch another.
        restless: share of the pieces that rock, roll a little or slide.
        fruit: how many pieces come; None for ever.
        settling_s: after which the slowest projector's light is steady. From then on projectors are switched, and where
            two shine on one place they disturb each other; 0 for projectors that shine always and disturb nobody.
        depth_error: how far depth of the devices is off, 1 for as much as such devices are as sold; 0 for not at all.
    """

    rig_seed: int = 1
    seed: int = 1
    layout: str = "opposed"
    sensors: int = 0
    rate_hz: float = 5.0
    speed_m_s: float = 0.12
    per_metre: float = 10.0
    kinds: tuple[str, ...] = KINDS
    foreign: float = 0.0
    touching: float = 0.0
    restless: float = 0.35
    fruit: int | None = None
    settling_s: float = 0.0
    depth_error: float = 0.0

    def setting(self) -> Setting:
        """Return the rig in its place."""
        much = self.depth_error
        conditions = Conditions(
            depth_model=DepthModel(radial_error=much * RADIAL_ERROR),
            scale_error=much * SCALE_ERROR,
            offset_m=much * OFFSET_M,
        )
        setting = make_setting(self.rig_seed, self.layout, self.sensors, True, conditions)
        return replace(setting, devices=tuple(map(_another, setting.devices))) if much else setting


def _another(device: Device) -> Device:
    """Return a device under a serial of its own: what is kept of one that errs is not put on one that does not."""
    return replace(device, serial=f"{device.serial}D")


def supply(options: LineOptions, setting: Setting) -> Iterator[list[Body]]:
    """Yield batches of bodies for ever, or until `fruit` have come; numbers and places go on from batch to batch."""
    low_m, high_m = sight_of(setting)
    front_m, number, left = low_m - BEFORE_SIGHT_M, 0, options.fruit
    batch = 0
    while left is None or left > 0:
        count = BATCH if left is None else min(BATCH, left)
        bodies = _batch(options, setting, batch, count)
        shift_m = front_m - max(body.start_m[0] + body.reach_m() for body in bodies)
        moved = [body.at((body.start_m[0] + shift_m, body.start_m[1])) for body in bodies]
        front_m = min(body.start_m[0] - body.reach_m() for body in moved) - 1.0 / options.per_metre
        rng = np.random.default_rng([options.seed, 21, batch])
        yield [
            _begun(replace(body, fruit_id=number + at + 1), options.speed_m_s, float(rng.uniform(low_m, high_m)))
            for at, body in enumerate(moved)
        ]
        number += len(moved)
        left = None if left is None else left - count
        batch += 1


def _batch(options: LineOptions, setting: Setting, batch: int, count: int) -> list[Body]:
    rng = np.random.default_rng([options.seed, 20, batch])
    half_m = setting.surroundings.belt.width_m / 2
    foreign = int(rng.binomial(count, options.foreign))
    things = [
        made_restless(body, rng) if rng.random() < options.restless else body
        for body in mixed(rng, count - foreign, options.kinds, foreign)
    ]
    return stream(clusters(things, options.touching, rng, half_m - 0.01), half_m, options.per_metre, rng)


def _begun(body: Body, speed_m_s: float, at_m: float) -> Body:
    """Let a body's own motion begin where it passes an x of the world."""
    return replace(body, wobble=replace(body.wobble, start_s=(at_m - body.start_m[0]) / speed_m_s))


def crossed(options: LineOptions, belt_s: float) -> list[TrueFruit]:
    """Return what has come and gone by the time that the belt has run `belt_s`: entered and left all sensors' sight."""
    setting = options.setting()
    _, high_m = sight_of(setting)
    gone: list[TrueFruit] = []
    for batch in supply(options, setting):
        behind = [one for one in batch if has_left(one, options.speed_m_s * belt_s, high_m)]
        gone += [measured_on_mesh(body) for body in behind]
        if not behind:
            break
    return gone


def has_left(body: Body, travel_m: float, high_m: float) -> bool:
    """Tell whether a body is past the sensors' sight, which ends at an x of the world."""
    return body.start_m[0] + travel_m > high_m + BEFORE_SIGHT_M
