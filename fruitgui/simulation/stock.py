"""What is put on the belt: fruit and foreign objects, as they come to rest, and what they do by themselves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.random import Generator

from fruitgui.simulation.body import Body, at_rest
from fruitgui.simulation.foreign import FOREIGN
from fruitgui.simulation.fruit import grow
from fruitgui.simulation.motion import SpeedProfile, Wobble
from fruitgui.simulation.oddments import ODDMENTS

STRANGE = tuple(sorted(FOREIGN))
"""Foreign objects that come unless others are named."""

_MAKERS = {**FOREIGN, **ODDMENTS}


def mixed(
    rng: Generator, fruit: int, kinds: Sequence[str], foreign: int, foreign_kinds: Sequence[str] = STRANGE
) -> list[Body]:
    """Return fruit of all kinds in turn, shuffled, and foreign objects among them, at rest at the origin."""
    names = [kinds[number % len(kinds)] for number in range(fruit)]
    start = int(rng.integers(len(foreign_kinds)))
    names += [foreign_kinds[(start + number) % len(foreign_kinds)] for number in range(foreign)]
    order = rng.permutation(len(names)).tolist()
    return numbered([replace(make_body(names[number], rng), foreign=number >= fruit) for number in order])


def make_body(kind: str, rng: Generator) -> Body:
    """Return one thing at rest at the origin: apples mostly upright, long fruit on their side."""
    if kind in _MAKERS:
        return Body(0, kind, at_rest(_MAKERS[kind](rng).centred(), rng, 0.0), (0.0, 0.0), foreign=True)
    mesh = grow(kind, rng)
    upright = "apple" in kind and rng.random() < 0.6
    lying = float(rng.choice([0.0, np.pi])) if upright else float(rng.uniform(0.35, 0.65) * np.pi)
    return Body(0, kind, at_rest(mesh, rng, lying), (0.0, 0.0))


def numbered(bodies: Sequence[Body]) -> list[Body]:
    """Return the bodies with ids from 1."""
    return [replace(body, fruit_id=number + 1) for number, body in enumerate(bodies)]


def made_restless(body: Body, rng: Generator) -> Body:
    """Give a fruit a motion of its own: it rocks, and may roll a little about its long axis or slide."""
    if body.foreign:
        return body
    spread = np.cov(body.mesh.vertices_m[:, :2].T)
    long_axis = np.linalg.eigh(spread)[1][:, 1]
    does = rng.choice(["rocks", "rolls", "slides"])
    heading, slide_m = rng.uniform(0, 2 * np.pi), rng.uniform(0.0, 0.02)
    roll_rad = float(rng.uniform(-0.7, 0.7))
    wobble = Wobble(
        axis_rad=float(np.arctan2(long_axis[1], long_axis[0])),
        rock_rad=float(rng.uniform(0.02, 0.12)),
        rock_hz=float(rng.uniform(0.8, 2.5)),
        decay_s=float(rng.uniform(1, 4)),
        roll_rad=roll_rad if does == "rolls" else 0.0,
        roll_s=float(rng.uniform(0.5, 2.0)),
        slide_m=(float(slide_m * np.cos(heading)), float(slide_m * np.sin(heading)))
        if does == "slides"
        else (0.0, 0.0),
    )
    return replace(body, wobble=wobble)


def begun(body: Body, speed: SpeedProfile, low_m: float, high_m: float, rng: Generator) -> Body:
    """Let a body's own motion begin while it is between two x of the world."""
    start_s = speed.time_at(rng.uniform(low_m, high_m) - body.start_m[0])
    return replace(body, wobble=replace(body.wobble, start_s=start_s))


def shoved(bodies: Sequence[Body], moved_m: float, time_s: float, rng: Generator) -> list[Body]:
    """Shove two thirds of the bodies, each its own way by about `moved_m`, at a time."""
    moved = []
    for body in bodies:
        heading, far = rng.uniform(0, 2 * np.pi), moved_m * rng.uniform(0.7, 1.3)
        jump_m = (float(far * np.cos(heading)), float(far * np.sin(heading)))
        moved.append(replace(body, jump_m=jump_m, jump_s=time_s) if rng.random() < 2 / 3 else body)
    return moved
