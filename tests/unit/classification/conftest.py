"""One trained model for the tests that only look at it."""

from __future__ import annotations

import pytest

from fruitgui.classification.account import Training
from fruitgui.classification.evidence import LabelledFruit
from fruitgui.classification.model import KindModel
from fruitgui.classification.training import train
from tests.unit.classification.orchard import NAMES, Orchard


@pytest.fixture(scope="session")
def orchard() -> Orchard:
    return Orchard.planted(kinds=4, apart=9.0, seed=1)


@pytest.fixture(scope="session")
def trained(orchard: Orchard) -> Training[KindModel]:
    return train(orchard.harvest(each=20, views=12, seed=2), NAMES, seed=3)


@pytest.fixture(scope="session")
def few(orchard: Orchard) -> list[LabelledFruit]:
    """Four fruit of each kind, five views each."""
    return orchard.harvest(each=4, views=5, seed=7)


@pytest.fixture(scope="session")
def told(few: list[LabelledFruit]) -> tuple[Training[KindModel], list[float]]:
    """A training on few fruit, with what it told of its progress."""
    shares: list[float] = []
    return train(few, NAMES, seed=5, progress=lambda share, _: shares.append(share)), shares
