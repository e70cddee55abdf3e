"""A model as plain numbers and words, for a file that holds no code; and back, believing nothing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fruitgui.classification.axes import axes_of
from fruitgui.classification.decision import Novelty, Weighing
from fruitgui.classification.density import Density
from fruitgui.classification.evidence import FeatureNames
from fruitgui.classification.kinds import checked_kinds
from fruitgui.classification.model import Core, KindModel
from fruitgui.classification.network import Network
from fruitgui.errors import InputError
from fruitgui.frame import F64

Settings = dict[str, Any]
Arrays = dict[str, F64]

MAX_FEATURES = 1024
MAX_LAYERS = 4
MAX_NEURONS = 1024
MAX_STRANGERS = 200
_NOVELTY = ("centres", "spreads", "thresholds")


def to_parts(model: KindModel) -> tuple[Settings, Arrays]:
    """Return the model as settings that JSON can hold, and named arrays of float64."""
    core = model.core
    settings: Settings = {
        "kinds": list(model.kinds),
        "view_features": list(core.names.view),
        "fruit_features": list(core.names.fruit),
        "layers": len(core.network.weights),
        "weighing": {"views": model.weighing.views, "fruit": model.weighing.fruit},
        "density": {"views": core.density.views},
        "strangers": 0 if core.strangers is None else len(core.strangers.means),
    }
    arrays: Arrays = {
        "views/centre": core.centre,
        "views/unit": core.unit,
    }
    for layer, (weight, bias) in enumerate(zip(core.network.weights, core.network.biases, strict=True)):
        arrays |= {f"network/weight_{layer}": weight, f"network/bias_{layer}": bias}
    arrays |= _arrays_of("density", core.density)
    arrays |= {f"unknown/{name}": getattr(model.novelty, name) for name in _NOVELTY}
    if core.strangers is not None:
        arrays |= {"strangers/means": core.strangers.means, "strangers/covariance": core.strangers.covariances[0]}
    return settings, arrays


def _arrays_of(name: str, density: Density) -> Arrays:
    return {
        f"{name}/unit": density.unit,
        f"{name}/means": density.means,
        f"{name}/covariances": density.covariances,
        f"{name}/counts": density.counts,
        f"{name}/view_spread": density.view_spread,
    }


def from_parts(settings: Mapping[str, Any], arrays: Mapping[str, Any], names: FeatureNames) -> KindModel:
    """Return the model that the parts describe.

    Args:
        settings: as `to_parts` gave them, read from a file that may be anything.
        arrays: likewise.
        names: the features that this version computes.

    Raises:
        InputError: a part is missing, of the wrong kind or shape, not finite, out of range; or the model was
            trained on other features than this version's; `where` names the part.
    """
    reader = _Reader({**settings, **arrays})
    kinds = checked_kinds(reader.words("kinds"))
    trained = FeatureNames(tuple(reader.words("view_features")), tuple(reader.words("fruit_features")))
    if trained != names:
        raise InputError(
            "other_features",
            "The model was trained on other features than this version computes.",
            "Train it again with this version.",
            where="view_features" if trained.view != names.view else "fruit_features",
        )
    axes, count = axes_of(names), len(kinds)
    width = len(axes.view)
    density = _density(reader, len(axes.every), count)
    core = Core(
        names,
        reader.array("views/centre", (width,)),
        reader.positive("views/unit", (width,)),
        _network(reader, width, count),
        density,
        _strangers(reader, density),
    )
    weighing = Weighing(reader.number("weighing", "views", 0.0, 1e3), reader.number("weighing", "fruit", 0.0, 1e3))
    novelty = Novelty(*(reader.positive(f"unknown/{name}", (count,)) for name in _NOVELTY))
    return KindModel(kinds, core, weighing, novelty)


def _density(reader: _Reader, depth: int, count: int) -> Density:
    return Density(
        reader.positive("density/unit", (depth,)),
        reader.array("density/means", (count, depth)),
        reader.covariance("density/covariances", (count, depth, depth)),
        reader.positive("density/counts", (count,)),
        reader.covariance("density/view_spread", (depth, depth), least=0.0),
        reader.number("density", "views", 1.0, 1e6),
    )


def _strangers(reader: _Reader, density: Density) -> Density | None:
    count = reader.whole("strangers", 0, MAX_STRANGERS)
    if count == 0:
        return None
    depth = len(density.unit)
    means = reader.array("strangers/means", (count, depth))
    covariance = reader.covariance("strangers/covariance", (depth, depth))
    return Density(
        density.unit,
        means,
        np.broadcast_to(covariance, (len(means), depth, depth)),
        np.ones(len(means)),
        density.view_spread,
        density.views,
    )


def _network(reader: _Reader, width: int, count: int) -> Network:
    layers = reader.whole("layers", 1, MAX_LAYERS)
    weights: list[F64] = []
    for layer in range(layers):
        inner = None if layer < layers - 1 else count
        weights.append(reader.array(f"network/weight_{layer}", (width, inner)))
        width = weights[-1].shape[1]
        if not 1 <= width <= MAX_NEURONS:
            raise _bad(f"network/weight_{layer}", f"has {width} columns")
    biases = [reader.array(f"network/bias_{layer}", (weight.shape[1],)) for layer, weight in enumerate(weights)]
    return Network(tuple(weights), tuple(biases))


@dataclass(frozen=True, slots=True)
class _Reader:
    """Takes parts, each checked before it is used."""

    parts: Mapping[str, Any]

    def get(self, name: str) -> Any:  # noqa: ANN401 - a file may hold anything
        if name not in self.parts:
            raise _bad(name, "is missing")
        return self.parts[name]

    def words(self, name: str) -> Sequence[str]:
        words = self.get(name)
        if not isinstance(words, list) or len(words) > MAX_FEATURES or not all(isinstance(w, str) for w in words):
            raise _bad(name, f"must be a list of at most {MAX_FEATURES} words")
        return words

    def whole(self, name: str, low: int, high: int) -> int:
        value = self.get(name)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise _bad(name, f"must be a whole number from {low} to {high}")
        return value

    def number(self, name: str, key: str, low: float, high: float) -> float:
        record = self.get(name)
        value = record.get(key) if isinstance(record, dict) else None
        if not isinstance(value, int | float) or isinstance(value, bool) or not low <= value <= high:
            raise _bad(f"{name}.{key}", f"must be a number from {low:g} to {high:g}")
        return float(value)

    def array(self, name: str, shape: tuple[int | None, ...]) -> F64:
        array = self.get(name)
        if not isinstance(array, np.ndarray) or array.dtype.kind != "f" or array.ndim != len(shape):
            raise _bad(name, f"must be an array of {len(shape)} axes of floating-point numbers")
        if any(want is not None and want != have for want, have in zip(shape, array.shape, strict=True)):
            raise _bad(name, f"has shape {array.shape}, want {shape}")
        if array.size > MAX_NEURONS**2 * 64 or not np.isfinite(array).all():
            raise _bad(name, "holds a number that is not finite, or too many")
        return np.asarray(array, dtype=np.float64)

    def positive(self, name: str, shape: tuple[int, ...]) -> F64:
        array = self.array(name, shape)
        if not (array > 0.0).all():
            raise _bad(name, "must be above nought")
        return array

    def covariance(self, name: str, shape: tuple[int, ...], least: float = 1e-12) -> F64:
        array = self.array(name, shape)
        size = 1e-8 * (1.0 + np.abs(array).max(initial=0.0))
        if np.abs(array - array.swapaxes(-1, -2)).max(initial=0.0) > size:
            raise _bad(name, "must be symmetric")
        if array.size and np.linalg.eigvalsh(array).min() < least - size * (least <= 0.0):
            raise _bad(name, "must be a covariance")
        return array


def _bad(where: str, what: str) -> InputError:
    return InputError("bad_model", f"The model cannot be used: {where} {what}.", "Train it again.", where=where)
