"""One trained model for the tests that only look at it."""

from __future__ import annotations

import pytest

from fruitgui.classification.account import Training
from fruitgui.classification.model import KindModel
from fruitgui.classification.training import train
from tests.unit.classification.orchard import NAMES, Orchard


@pytest.fixture(scope="session")
def orchard() -> Orchard:
    return Orchard.planted(kinds=4, apart=9.0, seed=1)


@pytest.fixture(scope="session")
def trained(orchard: Orchard) -> Training[KindModel]:
    return train(orchard.harvest(each=20, views=12, seed=2), NAMES, seed=3)
