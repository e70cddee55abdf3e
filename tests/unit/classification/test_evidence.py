from __future__ import annotations

import numpy as np
import pytest

from fruitgui.classification.axes import axes_of, fruit_axes, view_axes
from fruitgui.classification.density import fruit_vectors, unheard
from fruitgui.classification.evidence import Evidence, FeatureNames
from fruitgui.classification.nature import FORM, LIGHT, NEIGHBOUR, borne_changes
from fruitgui.errors import InputError
from fruitgui.frame import F64
from fruitgui.perception.colour import DARK_LEVEL
from fruitgui.perception.features import FEATURE_NAMES

NAMES = FeatureNames(FEATURE_NAMES, ("volume_m3", "length_m", "diameter_m", "perimeter_m", "height_m"))


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


def test_every_axis_bears_a_change_and_every_change_names_an_axis() -> None:
    """A renamed feature would silently bear nothing."""
    axes = axes_of(NAMES)
    assert {*FORM, *(name for change in LIGHT for name in change)} == {*axes.every}
    assert {*NEIGHBOUR} <= {axes.every[at] for at in axes.lone} - {axes.every[at] for at in axes.outline}
    assert borne_changes(axes).any(axis=0).all()


def test_a_neighbour_leaves_middle_colours_alone() -> None:
    axes = axes_of(NAMES)
    left = {name for at, name in enumerate(axes.every) if at not in axes.lone}
    assert {"chroma_red_green_p50", "chroma_value_to_belt", "texture_step"} <= left
    assert not left & {"chroma_red_std", "shape_solidity", "size_length", "volume_m3"}


def _evidence(alone: bool, whole: bool, spread: float = 0.0) -> Evidence:
    views = np.ones((6, len(NAMES.view))) + spread * np.random.default_rng(0).standard_normal((6, len(NAMES.view)))
    return Evidence(views.astype(np.float32), np.full(5, 0.1), alone, whole)


def test_a_neighbour_silences_the_outlines_form_only_and_an_edge_all_shapes_and_sizes() -> None:
    axes = axes_of(NAMES)
    assert len(unheard(_evidence(alone=True, whole=True), NAMES)) == 0
    touching = {axes.every[at] for at in unheard(_evidence(alone=False, whole=True), NAMES)}
    assert {"shape_solidity", "shape_ellipse_error"} <= touching
    assert not touching & {"size_height", "shape_width_to_length", "volume_m3"}
    assert {*unheard(_evidence(alone=False, whole=False), NAMES)} == {*axes.lone}


def test_sizes_of_what_others_touch_count_less_and_less_again_where_views_disagree() -> None:
    at = axes_of(NAMES).every.index("size_length")
    lone, touching, torn = fruit_vectors(
        [_evidence(True, True, 0.3), _evidence(False, True), _evidence(False, True, 0.3)], NAMES
    ).borne[:, at]
    assert lone == 0.0
    assert 0.0 < touching < torn


def _seen(skin: F64, belt: F64, light: F64) -> F64:
    """Return the features (1, F) of a skin of one colour over a belt, levels of each scaled by the light."""
    (red, green, blue), (belt_red, belt_green, belt_blue) = (np.log(what * light + DARK_LEVEL) for what in (skin, belt))
    said = {
        "light_value_p50": green,
        "chroma_value_to_belt": green - belt_green,
        "chroma_red_green_to_belt": red - green - (belt_red - belt_green),
        "chroma_blue_green_to_belt": blue - green - (belt_blue - belt_green),
    }
    for share in ("p10", "p50", "p90"):
        said |= {f"chroma_red_green_{share}": red - green, f"chroma_blue_green_{share}": blue - green}
    return np.array([[said.get(name, 0.0) for name in NAMES.view]])


def test_exposure_and_colour_of_the_light_cancel() -> None:
    skin, belt = np.array([70.0, 40.0, 20.0]), np.array([90.0, 110.0, 100.0])
    lights = np.array([[1.0, 1.0, 1.0], [0.55, 0.5, 0.4], [1.7, 1.9, 2.2]])
    seen = [view_axes(_seen(skin, belt, light), NAMES) for light in lights]
    assert np.abs(seen[0] - seen[1]).max() < 1e-9
    assert np.abs(seen[0] - seen[2]).max() < 1e-9


def test_black_beside_a_black_belt_is_finite() -> None:
    black = np.zeros(3)
    assert np.isfinite(view_axes(_seen(black, black, np.ones(3)), NAMES)).all()


def test_a_larger_fruit_of_the_same_form_differs_along_one_axis() -> None:
    names = axes_of(NAMES)
    views = np.zeros((1, len(NAMES.view)))
    larger = views + [0.1 if name.startswith("size_") else 0.0 for name in NAMES.view]
    fused = np.array([2e-4, 0.08, 0.07, 0.22, 0.06])
    whole = []
    for seen, size in ((views, fused), (larger, fused * np.exp([0.3, 0.1, 0.1, 0.1, 0.1]))):
        rows = view_axes(seen, NAMES)
        whole.append(np.concatenate([rows[0], fruit_axes(size, rows[0], NAMES)]))
    moved = [name for name, shift in zip(names.every, whole[1] - whole[0], strict=True) if abs(shift) > 1e-9]
    assert moved == ["size_root_area"]


def test_names_without_a_belt_pass_as_they_are() -> None:
    names = FeatureNames(("chroma_red_mean", "shape_a"), ("volume_m3",))
    views = np.array([[0.3, 0.7]])
    assert np.array_equal(view_axes(views, names), views)
    assert np.allclose(fruit_axes(np.array([np.e**3]), views[0], names), [1.0])
