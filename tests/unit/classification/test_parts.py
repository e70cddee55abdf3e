from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from fruitgui.classification.account import Training
from fruitgui.classification.density import fruit_vectors
from fruitgui.classification.evidence import UNKNOWN, FeatureNames
from fruitgui.classification.fitting import around
from fruitgui.classification.model import KindModel
from fruitgui.classification.parts import from_parts, to_parts
from fruitgui.errors import InputError
from tests.unit.classification.orchard import NAMES, Orchard


def test_a_model_survives_its_parts(trained: Training[KindModel], orchard: Orchard) -> None:
    settings, arrays = to_parts(trained.model)
    again = from_parts(json.loads(json.dumps(settings, allow_nan=False)), arrays, NAMES)
    for one in orchard.harvest(each=3, views=4, seed=21):
        assert again.vote(one.evidence) == trained.model.vote(one.evidence)


def test_strangers_survive_too(trained: Training[KindModel], orchard: Orchard) -> None:
    strange = orchard.fruit(0, 3, np.random.default_rng(1))
    core = trained.model.core
    model = replace(trained.model, core=replace(core, strangers=around(core.density, fruit_vectors([strange], NAMES))))
    again = from_parts(*to_parts(model), NAMES)
    assert again.vote(strange) == model.vote(strange)
    assert again.vote(strange).kind == UNKNOWN


def test_other_features_mean_training_again(trained: Training[KindModel]) -> None:
    other = FeatureNames((*NAMES.view[1:], "chroma_new"), NAMES.fruit)
    with pytest.raises(InputError, match="other features") as caught:
        from_parts(*to_parts(trained.model), other)
    assert "again" in caught.value.remedy


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("kinds", []),
        ("kinds", ["a", "a", "b", "c"]),
        ("kinds", ["a", "b", "c", UNKNOWN]),
        ("kinds", ["a", "b", "c", "d\x00"]),
        ("kinds", ["a", "b", "c", 4]),
        ("layers", 99),
        ("layers", True),
        ("weighing", {"views": float("nan"), "fruit": 0.1}),
        ("weighing", None),
        ("unknown/thresholds", np.array([3.0, 3.0, 3.0, -1.0])),
        ("unknown/spreads", np.full(3, 0.1)),
        ("strangers", 10**9),
        ("views/centre", np.zeros(3)),
        ("views/unit", np.zeros(30)),
        ("network/weight_0", np.full((30, 32), np.inf)),
        ("network/weight_0", np.zeros((30, 32), dtype=complex)),
        ("network/weight_0", [[1.0]]),
        ("density/covariances", np.zeros((4, 34, 34))),
        ("density/covariances", -np.stack([np.eye(34)] * 4)),
        ("density/covariances", np.stack([np.triu(np.ones((34, 34)))] * 4)),
        ("density/counts", np.zeros(4)),
    ],
)
def test_spoiled_parts_are_refused(trained: Training[KindModel], name: str, value: object) -> None:
    settings, arrays = to_parts(trained.model)
    (arrays if name in arrays else settings)[name] = value
    with pytest.raises(InputError) as caught:
        from_parts(settings, arrays, NAMES)
    assert caught.value.code in ("bad_model", "bad_kinds")


def test_every_part_is_needed(trained: Training[KindModel]) -> None:
    settings, arrays = to_parts(trained.model)
    for name in (*settings, *arrays):
        left = {key: value for key, value in settings.items() if key != name}
        with pytest.raises(InputError):
            from_parts(left, {key: value for key, value in arrays.items() if key != name}, NAMES)
