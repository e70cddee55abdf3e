"""One sensor carried round a table by an arm: views from known poses, for the error study."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tests.second_rig.camera import KINECT, Lens, Stand, aim
from tests.second_rig.kinect import Noise
from tests.second_rig.mcap_files import PLAIN, Message, shot_messages, write_mcap
from tests.second_rig.produce import KINDS, grow
from tests.second_rig.render import Renderer, Shot
from tests.second_rig.scene import Actor, Eye, Scene
from tests.second_rig.setting import Block, Setting
from tests.second_rig.stills import scatter
from tests.second_rig.truth_files import write_poses

NAME = "arm"
PERIOD_S = 2.0


@dataclass(frozen=True, slots=True)
class ArmPlan:
    """Where the arm carries the sensor.

    Attributes:
        distance_m: of the sensor from what it looks at. above_deg: of its line of sight over the table.
        turn_deg: how far round the table the views go.
    """

    views: int = 10
    distance_m: tuple[float, float] = (0.7, 1.5)
    above_deg: tuple[float, float] = (28.0, 75.0)
    turn_deg: float = 360.0
    fruit: int = 24
    boxes: int = 5
    lens: Lens = KINECT
    noise: Noise = Noise()  # noqa: RUF009 - frozen


def arm(seed: int, plan: ArmPlan) -> tuple[Scene, list[Stand]]:
    """Return a table with boxes and fruit, and the stands from which one sensor looks at it, in order."""
    rng = np.random.default_rng([seed, 5])
    blocks = _boxes(plan.boxes, rng)
    setting = Setting(
        width_m=float(rng.uniform(1.0, 1.3)), ends_m=(-float(rng.uniform(0.5, 0.7)), float(rng.uniform(0.5, 0.7))),
        floor_m=-0.72, belt_colour=(150.0, 128.0, 102.0), blocks=blocks, seed=int(rng.integers(1 << 30)),
    )  # fmt: skip
    fruit = [grow(KINDS[n % len(KINDS)], rng) for n in range(plan.fruit)]
    lying = scatter(fruit, np.zeros(2), np.array([0.4, 0.4]), rng)
    actors = tuple(one for one in lying if not any(_inside(one, block) for block in blocks))
    eye = Eye(NAME, aim(np.array([0.0, -0.5, 1.0]), np.zeros(3)), plan.lens, plan.noise, period_s=PERIOD_S)
    stands = [_stand(n, plan, rng) for n in range(plan.views)]
    return Scene(seed, setting, (eye,), actors, plan.views * PERIOD_S), stands


def _boxes(count: int, rng: np.random.Generator) -> tuple[Block, ...]:
    """Return boxes of all sizes, some run into one another."""
    found: list[Block] = []
    for _ in range(count):
        size = rng.uniform((0.06, 0.06, 0.04), (0.28, 0.2, 0.24))
        long, wide, high = size.tolist()
        x, y = rng.uniform(-0.35, 0.35, 2).tolist()
        red, green, blue = rng.uniform(60.0, 220.0, 3).tolist()
        low, top = (x - long / 2, y - wide / 2, -0.02), (x + long / 2, y + wide / 2, high)
        found.append(Block(low, top, (red, green, blue)))
    return tuple(found)


def _inside(actor: Actor, block: Block) -> bool:
    reach = actor.thing.body.radius_m
    spot = actor.origin_m[:2]
    return bool(np.all(spot > np.array(block.low_m[:2]) - reach) and np.all(spot < np.array(block.high_m[:2]) + reach))


def _stand(number: int, plan: ArmPlan, rng: np.random.Generator) -> Stand:
    """Return a stand: all round the table, near and far, steep and flat, rolled."""
    round_rad = np.radians(plan.turn_deg * number / plan.views + rng.normal(0.0, 6.0))
    above_rad = np.radians(rng.uniform(*plan.above_deg))
    reach = np.cos(above_rad)
    towards = np.array([reach * np.cos(round_rad), reach * np.sin(round_rad), np.sin(above_rad)])
    target = np.append(rng.normal(0.0, 0.06, 2), 0.05)
    return aim(target + rng.uniform(*plan.distance_m) * towards, target, float(np.radians(rng.normal(0.0, 20.0))))


def record_arm(seed: int, plan: ArmPlan, folder: Path) -> tuple[Path, Path]:
    """Record every view once and write its pose; return recording and poses."""
    scene, stands = arm(seed, plan)
    recording = write_mcap(folder / f"arm-{seed}.mcap", _messages(scene, stands))
    rows = [(scene.start_s + n * PERIOD_S, _eye(scene, stand)) for n, stand in enumerate(stands)]
    return recording, write_poses(folder / f"arm-{seed}.csv", rows)


def _eye(scene: Scene, stand: Stand) -> Eye:
    eye = scene.eyes[0]
    return Eye(eye.name, stand, eye.lens, eye.noise, period_s=eye.period_s)


def shots(scene: Scene, stands: list[Stand]) -> Iterator[Shot]:
    """Yield what the sensor gives at every stand, one after the other."""
    renderer = Renderer(scene)
    for n, stand in enumerate(stands):
        yield renderer.shoot(_eye(scene, stand), n * PERIOD_S, n)


def _messages(scene: Scene, stands: list[Stand]) -> Iterator[Message]:
    for n, shot in enumerate(shots(scene, stands)):
        yield from shot_messages(scene, _eye(scene, stands[n]), n * PERIOD_S, shot, PLAIN)
