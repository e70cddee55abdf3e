"""Kinds on simulated lines: trained on one day, judged on another day, light and fruit of the same rig."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from fruitgui.classification.confusion import Confusion, Judged, confusion
from fruitgui.classification.evidence import Evidence, FeatureNames, LabelledFruit
from fruitgui.classification.training import train
from fruitgui.perception.features import FEATURE_NAMES
from fruitgui.perception.perceiver import Perceiver
from fruitgui.simulation import scenes
from fruitgui.simulation.simulation import Simulation

FUSED = ("volume_m3", "length_m", "diameter_m", "perimeter_m")
NAMES = FeatureNames(FEATURE_NAMES, FUSED)
NEAR_M = 0.05


def _crossed(simulation: Simulation, seed: int) -> list[LabelledFruit]:
    """Return the fruit with their views, put together by true positions, and true sizes within a few per cent."""
    rig = simulation.rig()
    perceivers = {
        name: Perceiver(name, simulation.device(name).color_camera, mount.surface)
        for name, mount in rig.mounts.items()
        if mount.surface is not None
    }
    seen: dict[int, list[np.ndarray]] = {one.fruit_id: [] for one in simulation.truth.fruit}
    for capture, frame in zip(simulation.captures, simulation.frames(), strict=True):
        places = {one: simulation.truth.position_m(one, capture.time_s) for one in seen}
        for view in perceivers[frame.sensor].observe(frame, capture.time_s).views:
            centre = simulation.truth.poses[frame.sensor].apply(view.centre_m)
            nearest = min(places, key=lambda one: float(np.linalg.norm(places[one] - centre)))
            if view.whole and not view.shared and np.linalg.norm(places[nearest] - centre) < NEAR_M:
                seen[nearest].append(view.features)
    random = np.random.default_rng(seed)
    crossed = []
    for one in simulation.truth.fruit:
        fused = np.array([one.volume_m3, one.length_m, one.diameter_m, one.perimeter_m])
        fused *= np.exp(np.array([0.03, 0.015, 0.015, 0.015]) * random.standard_normal(4))
        if seen[one.fruit_id]:
            evidence = Evidence(np.stack(seen[one.fruit_id]).astype(np.float32), fused)
            crossed.append(LabelledFruit(str(one.fruit_id), one.kind, evidence))
    return crossed


@dataclass(frozen=True)
class _Run:
    """A line on another day: all that passed, and the part of the foreign objects that looks like fruit."""

    all: Confusion
    alike: Confusion


ALIKE = ("orange", "pear", "potato", "stone")


@pytest.fixture(scope="module")
def run() -> _Run:
    def line(seed: int, lux: float, fruit: int, foreign: int) -> Simulation:
        return scenes.line_scene(
            seed, fruit, 0.25, foreign=foreign, rig_seed=21, captures_hz=2.5, per_metre=20.0,
            foreign_kinds=("hand", "leaf", "box", "cup", *ALIKE, *ALIKE), conditions=scenes.Conditions(lux=lux),
        )  # fmt: skip

    model = train(_crossed(line(71, 400.0, 50, 0), 1), NAMES, seed=1).model
    votes = [Judged(one, model.vote(one.evidence)) for one in _crossed(line(72, 150.0, 50, 36), 2)]
    return _Run(
        confusion(model.kinds, votes),
        confusion(model.kinds, [one for one in votes if one.fruit.kind in (*ALIKE, *model.kinds)]),
    )


@pytest.fixture
def judged(run: _Run) -> Confusion:
    return run.all


@pytest.mark.accuracy
def test_kinds_are_right_in_another_light(judged: Confusion) -> None:
    # 99 % of 50 fruit: one wrong is within chance (a third of lines), three are not (1.4 %).
    assert judged.right.trials >= 48
    assert judged.right.value >= 0.96, judged.counts


@pytest.mark.accuracy
def test_strangers_come_out_unknown(judged: Confusion) -> None:
    # Over twenty simulated days 98 % do; of 34, more than three pass by chance once in 200 lines.
    assert judged.strangers_found.trials >= 30
    assert judged.strangers_found.value >= 0.9, judged.counts


@pytest.mark.accuracy
def test_strangers_that_look_like_fruit_come_out_unknown(run: _Run) -> None:
    # Over twenty simulated days 97 % do; of 24, more than three pass by chance once in 180 lines.
    assert run.alike.strangers_found.trials >= 20
    assert run.alike.strangers_found.value >= 0.85, run.alike.counts


@pytest.mark.accuracy
def test_trained_kinds_are_never_confused(judged: Confusion) -> None:
    known = judged.counts[:-1, :-1]
    assert int(known.sum() - np.trace(known)) == 0, judged.counts
