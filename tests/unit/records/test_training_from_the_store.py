"""What was taught trains to the very model that it would have trained to without the store."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fruitgui.classification.evidence import Evidence, LabelledFruit
from fruitgui.measurement.fruit import Quantity
from fruitgui.records.store import Store
from fruitgui.records.taught import TaughtFruit
from fruitgui.station.judging import FEATURES
from fruitgui.station.model import read_model
from fruitgui.station.train_job import Taught, train_taught
from tests.unit.station.fruit_made import made_fruit


def _taught(number: int, kind: int) -> TaughtFruit:
    chance = np.random.default_rng([number, kind])
    likely = np.random.default_rng(kind)
    views = likely.uniform(0.05, 0.5, len(FEATURES.view)) * chance.lognormal(0, 0.05, (6, len(FEATURES.view)))
    fruit = likely.uniform(0.05, 0.5, len(FEATURES.fruit)) * chance.lognormal(0, 0.05, len(FEATURES.fruit))
    return TaughtFruit(
        source="morning.mcap", source_fruit=f"{kind}-{number}", sensors=("kinect_1",),
        evidence=Evidence(views.astype(np.float32), fruit), size=made_fruit(number).size, samples=(),
        kind=f"kind {kind}", volume_ml=made_fruit(number).volume_m3.value * 1e6, mass_g=None,
    )  # fmt: skip


def _plainly(fruit: TaughtFruit) -> Taught:
    assert fruit.kind is not None
    assert fruit.volume_ml is not None
    labelled = LabelledFruit(
        f"morning.mcap:{fruit.source_fruit}", fruit.kind, fruit.evidence, fruit.sensors, fruit.source
    )
    return Taught(labelled, fruit.size, fruit.volume_ml * 1e-6, None)


def test_training_from_the_store_is_training(store: Store, tmp_path: Path) -> None:
    fruit = [_taught(number, kind) for kind in range(2) for number in range(12)]
    store.teaching.add([(one, ()) for one in fruit])
    stored = train_taught(store.teaching.for_training(), {"lots": ["1184"]}, tmp_path / "stored.fruit")
    train_taught([_plainly(one) for one in fruit], {"lots": ["1184"]}, tmp_path / "plain.fruit")
    assert (tmp_path / "stored.fruit").read_bytes() == (tmp_path / "plain.fruit").read_bytes()
    model = read_model(tmp_path / "stored.fruit", FEATURES)
    assert model.trained_on["lots"] == ["1184"]
    assert {one["kind"]: one["fruit"] for one in model.trained_on["kinds"]} == {"kind 0": 12, "kind 1": 12}
    assert isinstance(stored.correction.correction.volume("kind 0", fruit[0].size), Quantity)
