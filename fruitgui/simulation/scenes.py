"""Ready scenes, each made from a seed: still ones for calibration, lines that run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from fruitgui.frame import Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.simulation.body import Body, at_rest
from fruitgui.simulation.device import KINECT_COLOR, Device, depth_camera_of
from fruitgui.simulation.foreign import FOREIGN, box_of, make_foreign
from fruitgui.simulation.fruit import KINDS, ball, grow
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.layouts import placements
from fruitgui.simulation.light import ColorModel, make_light
from fruitgui.simulation.motion import SpeedProfile, Wobble, constant
from fruitgui.simulation.packing import clusters, scatter, stream
from fruitgui.simulation.simulation import Capture, Scene, Simulation, sight_along_belt
from fruitgui.simulation.surroundings import Surroundings, make_belt, rails


@dataclass(frozen=True, slots=True)
class Conditions:
    """Light and sensors of a scene; every effect of `depth_model` can be set there.

    Attributes:
        lux: light on the belt; None draws 100–1000.
        depth_model: what all sensors share.
        fattening_px: of edges; None draws 0.3–1.6 px per sensor.
        scale_error: depth scale errors of sensors are drawn evenly from ± this.
        offset_m: depth offsets are drawn evenly from ± this.
        camera: the colour camera; its resolution is the frames'.
        clock_offset_s: clock offsets of all but the reference are drawn evenly from ± this.
        drop_share: share of frames lost.
    """

    lux: float | None = None
    depth_model: DepthModel = DepthModel()
    fattening_px: float | None = None
    scale_error: float = 0.0
    offset_m: float = 0.0
    camera: Intrinsics = KINECT_COLOR
    clock_offset_s: float = 0.0
    drop_share: float = 0.0


USUAL = Conditions()
"""Nominal Kinects without depth bias, under light drawn by the seed."""


def still_scene(
    seed: int, layout: str = "opposed", fruit: int = 15, *, sensors: int = 0, captures: int = 5, with_rails: bool = True,
    kinds: Sequence[str] = KINDS, touching: float = 0.0, foreign: int = 0, moved_m: float = 0.0,
    conditions: Conditions = USUAL,
) -> Simulation:  # fmt: skip
    """Return a scene at rest.

    Args:
        seed: of all chance.
        layout: one of `layouts.LAYOUTS`.
        fruit: how many pieces; as many as fit are laid out.
        sensors: how many, 0 for the layout's own number.
        captures: of each sensor.
        with_rails: rails beside the belt.
        kinds: drawn from.
        touching: share of fruit that touch another.
        foreign: how many foreign objects lie among them.
        moved_m: someone shoves two thirds of the things by about this much between the sensors' captures.
        conditions: light and sensors.
    """
    rng = np.random.default_rng([seed, 0])
    poses = placements(layout, sensors, rng)
    bodies = _mixed(rng, fruit, kinds, foreign)
    surroundings = _surroundings(rng, with_rails)
    laid = _laid_out(bodies, poses, surroundings, touching, rng)
    if moved_m:
        laid = _shoved(laid, moved_m, rng)
    return _still(seed, rng, poses, laid, surroundings, captures, conditions)


def bare_belt(
    seed: int, layout: str = "opposed", *, with_rails: bool = True, captures: int = 5, conditions: Conditions = USUAL
) -> Simulation:
    """Return an empty belt at rest: nothing to register by."""
    return still_scene(seed, layout, 0, with_rails=with_rails, captures=captures, conditions=conditions)


def sphere_scene(
    seed: int, pattern: str = "row", *, count: int = 7, layout: str = "opposed", radius_m: float = 0.035,
    pitch_m: float = 0.11, with_rails: bool = True, captures: int = 5, conditions: Conditions = USUAL,
) -> Simulation:  # fmt: skip
    """Return equal spheres at equal distances, in a "row" of `count` or a "grid" of about `count` by 4, at rest."""
    rng = np.random.default_rng([seed, 0])
    poses = placements(layout, 0, rng)
    surroundings = _surroundings(rng, with_rails)
    sphere = ball(radius_m, (0.93, 0.52, 0.10))
    rows = 1 if pattern == "row" else 4
    places = [(i - (count - 1) / 2, j - (rows - 1) / 2) for i in range(count) for j in range(rows)]
    bodies = [Body(n + 1, "orange", sphere, (x * pitch_m, y * pitch_m)) for n, (x, y) in enumerate(places)]
    return _still(seed, rng, poses, bodies, surroundings, captures, conditions)


def box_scene(
    seed: int, layout: str = "opposed", boxes: int = 5, *, captures: int = 5, conditions: Conditions = USUAL
) -> Simulation:
    """Return a wide table at rest with boxes of several sizes on it."""
    rng = np.random.default_rng([seed, 0])
    poses = placements(layout, 0, rng)
    belt = make_belt(rng, rng.uniform(0.9, 1.3), (-float(rng.uniform(0.6, 0.9)), float(rng.uniform(0.6, 0.9))))
    surroundings = Surroundings(belt, (), float(rng.uniform(0.6, 0.8)), (0.45, 0.42, 0.40))
    bodies = []
    for number in range(boxes):
        mesh = box_of(rng.uniform((0.05, 0.05, 0.03), (0.25, 0.16, 0.20)), rng).centred()
        bodies.append(Body(number + 1, "box", at_rest(mesh, rng, 0.0), (0.0, 0.0), foreign=True))
    laid = scatter(clusters(bodies, 0.0, rng), np.array([-0.4, -0.4]), np.array([0.4, 0.4]), rng)
    return _still(seed, rng, poses, _numbered(laid), surroundings, captures, conditions)


def line_scene(
    seed: int, fruit: int = 60, speed_m_s: float = 0.1, touching: float = 0.0, foreign: int = 0, *,
    layout: str = "opposed", sensors: int = 0, kinds: Sequence[str] = KINDS, speed: SpeedProfile | None = None,
    per_metre: float = 14.0, captures_hz: float = 10.0, restless: float = 0.35, with_rails: bool = True,
    silent: Sequence[tuple[int, float, float]] = (), conditions: Conditions = USUAL,
) -> Simulation:  # fmt: skip
    """Return a line that runs from before its first fruit comes into sight until its last has left.

    Args:
        seed: of all chance.
        fruit: how many pieces.
        speed_m_s: of the belt, unless `speed` is given.
        touching: share of fruit that touch another.
        foreign: how many foreign objects come among them.
        layout: one of `layouts.LAYOUTS`.
        sensors: how many, 0 for the layout's own number.
        kinds: drawn from.
        speed: the belt's speed over time.
        per_metre: pieces per metre of belt.
        captures_hz: of all sensors together; they take turns.
        restless: share of pieces that rock, roll a little or slide.
        with_rails: rails beside the belt.
        silent: (number of the sensor from 0, from, to): spans in which a sensor gives nothing, seconds.
        conditions: light and sensors.
    """
    rng = np.random.default_rng([seed, 0])
    profile = speed or constant(speed_m_s)
    poses = placements(layout, sensors, rng)
    surroundings = _surroundings(rng, with_rails)
    devices = _devices(poses, conditions, silent, rng)
    light = make_light(rng, conditions.lux)
    empty = Simulation(Scene(seed, devices, surroundings, light, (), profile, ()))
    sights = [sight_along_belt(empty.rig_mount(device.sensor), device) for device in devices]
    low, high = min(sight[0] for sight in sights), max(sight[1] for sight in sights)
    half = surroundings.belt.width_m / 2
    bodies = [_restless(body, rng) if rng.random() < restless else body for body in _mixed(rng, fruit, kinds, foreign)]
    groups = clusters(bodies, touching, rng, half - 0.01)
    laid = stream(groups, half, per_metre, rng)
    first = max(body.start_m[0] for body in laid)
    laid = _numbered([body.at((body.start_m[0] - first + low - 0.25, body.start_m[1])) for body in laid])
    laid = [_begun(body, profile, low, high, rng) for body in laid]
    end_s = profile.time_at(high + 0.25 - min(body.start_m[0] for body in laid))
    captures = _turns(devices, end_s, captures_hz, rng)
    return Simulation(Scene(seed, devices, surroundings, light, tuple(laid), profile, captures))


def _mixed(rng: Generator, fruit: int, kinds: Sequence[str], foreign: int) -> list[Body]:
    """Return fruit of all kinds in turn, shuffled, and foreign objects among them, at rest at the origin."""
    names = [kinds[number % len(kinds)] for number in range(fruit)]
    strange = sorted(FOREIGN)
    start = int(rng.integers(len(strange)))
    names += [strange[(start + number) % len(strange)] for number in range(foreign)]
    bodies = []
    for number in rng.permutation(len(names)):
        bodies.append(_body(names[number], rng))
    return _numbered(bodies)


def _body(kind: str, rng: Generator) -> Body:
    if kind in FOREIGN:
        return Body(0, kind, at_rest(make_foreign(kind, rng), rng, 0.0), (0.0, 0.0), foreign=True)
    mesh = grow(kind, rng)
    upright = "apple" in kind and rng.random() < 0.6
    lying = float(rng.choice([0.0, np.pi])) if upright else float(rng.uniform(0.35, 0.65) * np.pi)
    return Body(0, kind, at_rest(mesh, rng, lying), (0.0, 0.0))


def _numbered(bodies: Sequence[Body]) -> list[Body]:
    return [replace(body, fruit_id=number + 1) for number, body in enumerate(bodies)]


def _surroundings(rng: Generator, with_rails: bool) -> Surroundings:
    width_m = float(rng.uniform(0.50, 0.62))
    grey = float(rng.uniform(0.25, 0.6))
    beside = rails(width_m, rng) if with_rails else ()
    return Surroundings(make_belt(rng, width_m), beside, float(rng.uniform(0.5, 0.9)), (grey, grey, grey))


def _laid_out(
    bodies: Sequence[Body], poses: Sequence[Pose], surroundings: Surroundings, touching: float, rng: Generator
) -> list[Body]:
    """Lay bodies out where the sensors look."""
    aims = [pose.translation_m + pose.rotation[:, 2] * (pose.translation_m[2] / -pose.rotation[2, 2]) for pose in poses]
    along = np.array([aim[0] for aim in aims])
    half = surroundings.belt.width_m / 2
    low, high = np.array([along.min() - 0.42, -half]), np.array([along.max() + 0.42, half])
    return _numbered(scatter(clusters(bodies, touching, rng), low, high, rng))


def _shoved(bodies: Sequence[Body], moved_m: float, rng: Generator) -> list[Body]:
    """Shove two thirds of the bodies, each its own way, half a second into the scene."""
    shoved = []
    for body in bodies:
        heading, far = rng.uniform(0, 2 * np.pi), moved_m * rng.uniform(0.7, 1.3)
        jump = (float(far * np.cos(heading)), float(far * np.sin(heading)))
        shoved.append(replace(body, jump_m=jump, jump_s=0.0) if rng.random() < 2 / 3 else body)
    return shoved


def _still(
    seed: int, rng: Generator, poses: Sequence[Pose], bodies: Sequence[Body], surroundings: Surroundings,
    captures: int, conditions: Conditions,
) -> Simulation:  # fmt: skip
    devices = _devices(poses, conditions, (), rng)
    light = make_light(rng, conditions.lux)
    turns = _turns(devices, captures * len(devices) * 0.1, 10.0, rng)
    middle_s = turns[len(turns) // 2].time_s - 1e-3 if turns else 0.0
    timed = tuple(replace(body, jump_s=middle_s) if body.jump_m != (0.0, 0.0) else body for body in bodies)
    return Simulation(Scene(seed, devices, surroundings, light, timed, constant(0.0), turns))


def _devices(
    poses: Sequence[Pose], conditions: Conditions, silent: Sequence[tuple[int, float, float]], rng: Generator
) -> tuple[Device, ...]:
    devices = []
    for number, pose in enumerate(poses):
        fattening = rng.uniform(0.3, 1.6) if conditions.fattening_px is None else conditions.fattening_px
        model = replace(
            conditions.depth_model,
            fattening_px=float(fattening),
            scale_error=conditions.depth_model.scale_error + float(rng.uniform(-1, 1) * conditions.scale_error),
            offset_m=conditions.depth_model.offset_m + float(rng.uniform(-1, 1) * conditions.offset_m),
        )
        balance = 1 + rng.normal(0, 0.02, 3)
        color = ColorModel(
            compliance=float(rng.uniform(0.05, 0.25)), vignetting=float(rng.uniform(0.05, 0.25)),
            balance=(float(balance[0]), float(balance[1]), float(balance[2])),
        )  # fmt: skip
        spans = tuple((start, end) for which, start, end in silent if which == number)
        offset_s = float(rng.uniform(-1, 1) * conditions.clock_offset_s)
        devices.append(
            Device(
                f"kinect_{number + 1}", pose, conditions.camera, depth_camera_of(conditions.camera), depth_model=model,
                color_model=color, clock_offset_s=offset_s if number else 0.0, silent_s=spans,
                drop_share=conditions.drop_share, serial=f"SIM{rng.integers(10**8):08d}",
            )  # fmt: skip
        )
    return tuple(devices)


def _turns(devices: Sequence[Device], end_s: float, captures_hz: float, rng: Generator) -> tuple[Capture, ...]:
    """Return captures one after the other, one projector at a time, with the jitter of a real schedule."""
    captures = []
    for number in range(int(end_s * captures_hz)):
        device = devices[number % len(devices)]
        time_s = (number + 0.5 + rng.uniform(-0.05, 0.05)) / captures_hz
        lost = rng.random() < device.drop_share or any(start <= time_s < end for start, end in device.silent_s)
        if not lost:
            captures.append(Capture(float(time_s), device.sensor))
    return tuple(captures)


def _restless(body: Body, rng: Generator) -> Body:
    """Give a body a motion of its own: it rocks, and may roll a little about its long axis or slide."""
    if body.foreign:
        return body
    spread = np.cov(body.mesh.vertices_m[:, :2].T)
    long_axis = np.linalg.eigh(spread)[1][:, 1]
    does = rng.integers(3)
    heading, slide_m = rng.uniform(0, 2 * np.pi), rng.uniform(0.0, 0.02) if does == 2 else 0.0
    wobble = Wobble(
        axis_rad=float(np.arctan2(long_axis[1], long_axis[0])), rock_rad=float(rng.uniform(0.02, 0.12)),
        rock_hz=float(rng.uniform(0.8, 2.5)), decay_s=float(rng.uniform(1, 4)),
        roll_rad=float(rng.uniform(-0.7, 0.7)) if does == 1 else 0.0, roll_s=float(rng.uniform(0.5, 2.0)),
        slide_m=(float(slide_m * np.cos(heading)), float(slide_m * np.sin(heading))),
    )  # fmt: skip
    return replace(body, wobble=wobble)


def _begun(body: Body, speed: SpeedProfile, low: float, high: float, rng: Generator) -> Body:
    """Let a body's own motion begin while it is in sight."""
    start_s = speed.time_at(rng.uniform(low, high) - body.start_m[0])
    return replace(body, wobble=replace(body.wobble, start_s=start_s))
