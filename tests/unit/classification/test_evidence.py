from __future__ import annotations

import numpy as np
import pytest

from fruitgui.classification.evidence import Evidence, FeatureNames
from fruitgui.classification.nature import CHANGES, Nature, borne_changes, natures, steadied
from fruitgui.errors import InputError
from fruitgui.perception.features import FEATURE_NAMES


@pytest.mark.parametrize(
    ("views", "fruit"),
    [
        (np.zeros((0, 3)), np.zeros(2)),
        (np.zeros(3), np.zeros(2)),
        (np.zeros((1, 3)), np.zeros((1, 2))),
        (np.full((1, 3), np.nan), np.zeros(2)),
        (np.zeros((1, 3)), np.full(2, np.inf)),
    ],
)
def test_features_that_cannot_be_are_refused(views: np.ndarray, fruit: np.ndarray) -> None:
    with pytest.raises(InputError):
        Evidence(views.astype(np.float32), fruit)


def test_what_was_not_measured_is_nan() -> None:
    assert Evidence(np.zeros((1, 3), np.float32), np.full(2, np.nan)).views == 1


def test_every_change_names_features_that_perception_computes() -> None:
    """A renamed feature would silently bear nothing."""
    fused = {"volume_m3", "length_m", "diameter_m", "perimeter_m", "height_m"}
    named = {name for change in CHANGES for name in change}
    assert named <= {*FEATURE_NAMES, *fused}
    assert borne_changes(FeatureNames(FEATURE_NAMES)).any(axis=0).all()


def test_perception_names_tell_colour_from_shape() -> None:
    what = dict(zip(FEATURE_NAMES, natures(FeatureNames(FEATURE_NAMES)), strict=True))
    assert what["chroma_red_mean"] is Nature.COLOUR
    assert what["texture_step"] is Nature.COLOUR
    assert what["shape_solidity"] is Nature.SHAPE
    assert what["size_length"] is Nature.SHAPE


def test_the_hue_of_grey_does_not_matter() -> None:
    names = FeatureNames(("chroma_hue_cosine", "chroma_hue_sine", "chroma_hue_strength", "chroma_saturation_mean"))
    red, green = steadied(np.array([[1.0, 0.0, 1.0, 0.01], [-0.5, 0.8, 0.4, 0.01]]), names)
    assert np.abs(red - green).max() < 0.02
