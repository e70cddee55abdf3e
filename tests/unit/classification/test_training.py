from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from fruitgui.classification.account import Training
from fruitgui.classification.confusion import Confusion, Judged, confusion
from fruitgui.classification.evidence import UNKNOWN, Evidence, LabelledFruit
from fruitgui.classification.model import KindModel
from fruitgui.classification.parts import to_parts
from fruitgui.classification.training import train
from fruitgui.errors import CancelledByUserError, InputError
from tests.unit.classification.orchard import NAMES, Orchard


def _judged(model: KindModel, fruit: Sequence[LabelledFruit]) -> Confusion:
    return confusion(model.kinds, [Judged(one, model.vote(one.evidence)) for one in fruit])


def test_new_fruit_get_their_kind(trained: Training[KindModel], orchard: Orchard) -> None:
    counted = _judged(trained.model, orchard.harvest(each=50, views=12, seed=9))
    # Kinds lie 9 standard deviations apart in their own metric: the best rule errs in 1e-5 of pairs.
    assert counted.right.value >= 0.985
    assert counted.rejected.value <= 0.01


def test_kinds_never_trained_are_unknown(trained: Training[KindModel]) -> None:
    strange = Orchard.planted(kinds=40, apart=20.0, seed=5).harvest(each=3, views=12, seed=6)
    assert _judged(trained.model, strange).strangers_found.value >= 0.95


def test_the_held_out_figures_are_near_those_of_new_fruit(trained: Training[KindModel], orchard: Orchard) -> None:
    new = _judged(trained.model, orchard.harvest(each=50, views=12, seed=10)).right.value
    assert trained.confusion.right.trials == 80
    assert trained.confusion.right.low <= new <= max(trained.confusion.right.high, 1.0)
    assert [point.fruit for point in trained.curve] == sorted(point.fruit for point in trained.curve)
    assert trained.curve[-1].right == trained.confusion.right


def test_one_piece_that_crossed_twice_is_held_out_as_one() -> None:
    """Kinds without any difference, every fruit with a twin: a model that saw a fruit or its twin could name it."""
    random = np.random.default_rng(2)
    same = Orchard.planted(kinds=1, apart=0.0, seed=1)
    pieces = [(str(n), f"kind {n % 2}", same.fruit(0, 6, random)) for n in range(30)]
    found = train([LabelledFruit(*piece) for piece in pieces for _ in range(2)], NAMES, seed=1)
    assert [one.fruit for one in found.taught] == [15, 15]
    assert found.confusion.right.trials == 60
    assert found.confusion.right.value < 0.75


def test_the_same_seed_gives_the_same_model(
    few: list[LabelledFruit], told: tuple[Training[KindModel], list[float]]
) -> None:
    (settings, arrays), (again, arrays_again) = (
        to_parts(training.model) for training in (told[0], train(few, NAMES, seed=5))
    )
    assert settings == again
    assert all(np.array_equal(arrays[name], arrays_again[name]) for name in arrays)


def test_probabilities_come_true() -> None:
    """Reliability: among held-out-like fruit, those said to be right with probability p are right about that often."""
    near = Orchard.planted(kinds=4, apart=3.5, seed=8)
    model = train(near.harvest(each=25, views=6, seed=1), NAMES, seed=1).model
    fruit = near.harvest(each=150, views=6, seed=2)
    shares = np.array([_given_known(model.vote(one.evidence).probabilities, one.kind) for one in fruit])
    said, right = shares[:, 0], shares[:, 1]
    assert 0.6 < right.mean() < 0.99
    for low, high in [(0.3, 0.6), (0.6, 0.8), (0.8, 0.95), (0.95, 1.01)]:
        chosen = (said >= low) & (said < high)
        if chosen.sum() >= 30:
            spread = np.sqrt(said[chosen].mean() * (1 - said[chosen].mean()) / chosen.sum())
            assert abs(said[chosen].mean() - right[chosen].mean()) < 0.08 + 3 * spread


def _given_known(probabilities: Mapping[str, float], kind: str) -> tuple[float, bool]:
    known = {name: value for name, value in probabilities.items() if name != UNKNOWN}
    best = max(known, key=known.__getitem__)
    return known[best] / sum(known.values()), best == kind


def test_few_labels_work_and_warn(orchard: Orchard) -> None:
    fruit = orchard.harvest(each=5, views=1, seed=3)
    found = train(fruit, NAMES, seed=1)
    counted = _judged(found.model, orchard.harvest(each=50, views=8, seed=4))
    assert counted.right.value >= 0.9
    assert sum("distinct fruit" in warning for warning in found.warnings) == 4
    assert sum("views" in warning for warning in found.warnings) == 4


def test_a_kind_with_one_fruit_is_trained_but_not_judged(orchard: Orchard) -> None:
    fruit = [one for one in orchard.harvest(each=6, views=6, seed=3) if not one.kind.endswith("3")]
    lone = orchard.harvest(each=1, views=6, seed=5)[3]
    found = train([*fruit, lone], NAMES, seed=1)
    assert found.confusion.right.trials == 18
    assert "kind 3" in found.model.kinds
    assert any("kind 3: only 1" in warning for warning in found.warnings)
    assert any(warning.startswith("Uneven") for warning in found.warnings)


@pytest.mark.parametrize("each", [1, 6])
def test_one_kind_alone_is_told_from_what_it_is_not(orchard: Orchard, each: int) -> None:
    own = [one for one in orchard.harvest(each=each, views=8, seed=3) if one.kind == "kind 0"]
    found = train(own, NAMES, seed=1)
    vote = found.model.vote(own[0].evidence)
    assert vote.kind == "kind 0"
    assert any("Only one kind" in warning for warning in found.warnings)
    far = Evidence(own[0].evidence.view_features + 30.0, own[0].evidence.fruit_features)
    assert found.model.vote(far).kind == UNKNOWN


def test_things_labelled_unknown_are_learned_from(trained: Training[KindModel], orchard: Orchard) -> None:
    """A stranger between two kinds, near enough to pass, is rejected once such strangers were shown."""
    fruit = orchard.harvest(each=15, views=8, seed=3)
    near = Orchard(orchard.means[:2].mean(axis=0, keepdims=True) * 0.9, orchard.mixing * 0.5, orchard.fused[:1])
    strangers = [
        LabelledFruit(f"stranger {n}", UNKNOWN, one.evidence) for n, one in enumerate(near.harvest(12, 8, seed=4))
    ]
    taught = train([*fruit, *strangers], NAMES, seed=1)
    new = near.harvest(each=40, views=8, seed=5)
    found = [sum(training.model.vote(one.evidence).kind == UNKNOWN for one in new) for training in (trained, taught)]
    assert found[1] > found[0]
    assert found[1] >= 0.9 * len(new)
    assert taught.confusion.counts[-1].sum() == 12
    assert taught.confusion.right.value >= 0.95


def test_progress_rises_and_cancel_stops(
    few: list[LabelledFruit], told: tuple[Training[KindModel], list[float]]
) -> None:
    assert told[1] == sorted(told[1])
    assert told[1][-1] == 1.0
    asked = iter(range(1000))
    with pytest.raises(CancelledByUserError):
        train(few, NAMES, cancelled=lambda: next(asked) > 30)


def test_bad_training_sets_are_refused(orchard: Orchard) -> None:
    fruit = orchard.harvest(each=2, views=2, seed=3)
    with pytest.raises(InputError, match="no labelled fruit"):
        train([], NAMES)
    with pytest.raises(InputError, match="features"):
        train([LabelledFruit("1", "a", Evidence(np.zeros((1, 3), np.float32), np.zeros(1)))], NAMES)
    with pytest.raises(InputError, match="printable"):
        train([LabelledFruit("1", "a\nb", fruit[0].evidence)], NAMES)
    many = [LabelledFruit(str(n), f"k{n}", fruit[0].evidence) for n in range(65)]
    with pytest.raises(InputError, match="65 kinds"):
        train(many, NAMES)


def test_a_fruit_that_could_not_be_measured_is_still_named(trained: Training[KindModel], orchard: Orchard) -> None:
    fruit = orchard.harvest(each=10, views=12, seed=12)
    blind = [
        LabelledFruit(one.fruit_id, one.kind, Evidence(one.evidence.view_features, np.full(4, np.nan))) for one in fruit
    ]
    assert _judged(trained.model, blind).right.value >= 0.95


def test_fewer_views_than_in_training_reject_no_more(trained: Training[KindModel], orchard: Orchard) -> None:
    counted = _judged(trained.model, orchard.harvest(each=50, views=1, seed=13))
    assert counted.rejected.value <= 0.03
    assert counted.right.value >= 0.95


def test_what_touches_others_is_known_by_its_size_too(trained: Training[KindModel], orchard: Orchard) -> None:
    one = orchard.fruit(1, 12, np.random.default_rng(4))
    swollen = one.fruit_features * np.array([125.0, 5.0, 5.0, 5.0])
    kinds = [
        trained.model.vote(Evidence(one.view_features, fruit, alone=False, whole=whole)).kind
        for fruit, whole in ((one.fruit_features, True), (swollen, True), (swollen, False))
    ]
    assert kinds == ["kind 1", UNKNOWN, "kind 1"]


def test_outlines_that_show_two_fruit_do_not_sway_the_perceptron(
    trained: Training[KindModel], orchard: Orchard
) -> None:
    """Shapes of another kind, as cutting a group wrongly gives them, count for a fruit that stands alone only."""
    one, other = (orchard.fruit(kind, 12, np.random.default_rng(6)).view_features for kind in (1, 2))
    shapes = [at for at, name in enumerate(NAMES.view) if name.startswith("shape_")]
    mixed = one.copy()
    mixed[:, shapes] = other[:, shapes]
    sizes = orchard.fruit(1, 12, np.random.default_rng(6)).fruit_features
    views = [
        trained.model.core.scores(Evidence(rows, sizes, alone=alone)).views
        for rows, alone in ((one, False), (mixed, False), (one, True), (mixed, True))
    ]
    assert np.allclose(views[0], views[1])
    assert views[0].argmax() == 1
    assert views[2][1] - views[3][1] > 1.0
