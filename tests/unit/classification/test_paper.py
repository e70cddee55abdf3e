from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, Evidence, FeatureNames, LabelledFruit
from fruitgui.classification.paper import train_paper
from tests.unit.classification.orchard import NAMES, Orchard

VIEWS_ONLY = FeatureNames(NAMES.view)


def _seen(fruit: Sequence[LabelledFruit]) -> list[LabelledFruit]:
    bare = np.zeros(0)
    return [LabelledFruit(one.fruit_id, one.kind, Evidence(one.evidence.view_features, bare)) for one in fruit]


def test_the_papers_way_names_fruit_and_never_says_unknown(orchard: Orchard) -> None:
    found = train_paper(_seen(orchard.harvest(each=10, views=5, seed=2)), VIEWS_ONLY, seed=1)
    assert found.confusion.right.value >= 0.9
    far = Evidence(np.full((3, len(NAMES.view)), 50.0, np.float32), np.zeros(0))
    vote = found.model.vote(far)
    assert vote.kind != UNKNOWN
    assert vote.probabilities[UNKNOWN] == 0.0


def test_the_papers_fruit_is_the_mean_of_its_views(orchard: Orchard) -> None:
    model = train_paper(_seen(orchard.harvest(each=4, views=5, seed=2)), VIEWS_ONLY, seed=1).model
    views = orchard.harvest(each=1, views=4, seed=3)[0].evidence.view_features
    alone = [model.vote(Evidence(views[[row]], np.zeros(0))).probabilities for row in range(4)]
    together = model.vote(Evidence(views, np.zeros(0))).probabilities
    for kind in model.kinds:
        assert np.isclose(together[kind], np.mean([one[kind] for one in alone]))
