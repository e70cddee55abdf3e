"""What a decision rests on: the views and the fused size of one fruit; and what the decision says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fruitgui.errors import InputError
from fruitgui.frame import F32, F64

UNKNOWN = "unknown"
"""The kind of a fruit that is none of the trained kinds."""


@dataclass(frozen=True, slots=True)
class FeatureNames:
    """What the numbers in an `Evidence` are, in order.

    A name that ends in a unit of length, area or volume (`_m`, `_m2`, `_m3`) is a size: positive,
    judged by ratio. See `axes` for the other words that names may begin with.
    """

    view: tuple[str, ...]
    fruit: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if len({*self.view, *self.fruit}) < len(self.view) + len(self.fruit):
            raise ValueError("two features have one name")


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """All that is known of one fruit when its kind is decided.

    Attributes:
        view_features: (n, F), one row per view, n ≥ 1, finite.
        fruit_features: (G,), of all views together (volume, length, …); NaN where it could not be measured.
        alone: the views show it whole and apart from others. The form of an outline that was cut out of a group is
            not listened to, and sizes less.
        whole: nothing cuts the views but a group. Of what the picture's edge cuts, neither shape nor size is listened
            to.

    Raises:
        InputError: a wrong shape, no view, or a view feature that is not finite.
    """

    view_features: F32
    fruit_features: F64
    alone: bool = True
    whole: bool = True

    def __post_init__(self) -> None:
        views, fruit = self.view_features, self.fruit_features
        if views.ndim != 2 or len(views) == 0 or fruit.ndim != 1:
            raise _bad_evidence(f"want views (n ≥ 1, F) and fruit (G,), have {views.shape} and {fruit.shape}")
        if not np.isfinite(views).all() or np.isinf(fruit).any():
            raise _bad_evidence("a feature is not a finite number")

    @property
    def views(self) -> int:
        """Number of views."""
        return len(self.view_features)


def _bad_evidence(what: str) -> InputError:
    return InputError("bad_evidence", f"The features of a fruit cannot be used: {what}.", "Leave this fruit out.")


@dataclass(frozen=True, slots=True, eq=False)
class LabelledFruit:
    """One piece of fruit to which a person gave a kind.

    Attributes:
        fruit_id: says which piece of fruit of its source this is. One that crossed twice is listed twice under
            one id; it is held out as one.
        kind: the person's word; `unknown` for a thing that is to be rejected.
        evidence: its views and size.
        sensors: ids of the sensors that saw it.
        source: where it comes from (a recording), for people.
    """

    fruit_id: str
    kind: str
    evidence: Evidence
    sensors: tuple[str, ...] = ()
    source: str = ""


@dataclass(frozen=True, slots=True)
class KindVote:
    """What one fruit is, and how sure that is.

    Attributes:
        kind: a trained kind, or `unknown`.
        probability: of that kind, 0–1.
        probabilities: of every trained kind and of `unknown`; they add up to one.
    """

    kind: str
    probability: float
    probabilities: Mapping[str, float]
