"""Product and paper splitting side by side, on simulated fruit of which a part touch."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import Frame, Ints
from fruitgui.geometry.plane import Surface
from fruitgui.perception.paper import KMeansSplitter
from fruitgui.perception.perceiver import Perceiver
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.view import FruitView
from fruitgui.simulation.simulation import Simulation

MOSTLY_SEEN = 0.6
"""Fruit of which less is seen by a sensor (the rest is hidden or out of the picture) need not be found by it."""


@dataclass(frozen=True, slots=True)
class SplitScore:
    """How fruit were told apart in single frames.

    Attributes:
        fruit: that should have been seen.
        once: seen as exactly one view.
        missed: no view of their own.
        several: seen as more than one.
        nothing: views of no fruit.
    """

    fruit: int = 0
    once: int = 0
    missed: int = 0
    several: int = 0
    nothing: int = 0

    def __add__(self, other: SplitScore) -> SplitScore:
        return SplitScore(
            self.fruit + other.fruit,
            self.once + other.once,
            self.missed + other.missed,
            self.several + other.several,
            self.nothing + other.nothing,
        )

    @property
    def error(self) -> float:
        """Part of the fruit that was missed or doubled, in single frames."""
        return (self.missed + self.several) / max(self.fruit, 1)


def compare_splitting(scenes: Iterable[Simulation]) -> dict[str, SplitScore]:
    """Return the scores of product and paper splitting over all frames of some scenes."""
    scores = {"product": SplitScore(), "paper": SplitScore()}
    for scene in scenes:
        for number in range(len(scene.captures)):
            frame = scene.frame(number)
            surface = scene.truth.surfaces[frame.sensor]
            owner, seen = whose_pixels(scene, number)
            for mode, perceiver in perceivers(frame, surface).items():
                views = perceiver.observe(frame, frame.time_s).views
                scores[mode] += score_views(views, owner, seen)
    return scores


def perceivers(frame: Frame, surface: Surface) -> dict[str, Perceiver]:
    """Return a product and a paper perceiver for a frame's sensor."""
    settings = PerceptionSettings()
    product = Perceiver(frame.sensor, frame.intrinsics, surface, settings)
    splitter = KMeansSplitter(product.limits, settings)
    return {"product": product, "paper": Perceiver(frame.sensor, frame.intrinsics, surface, settings, splitter)}


def whose_pixels(scene: Simulation, number: int) -> tuple[Ints, dict[int, float]]:
    """Return which fruit each pixel shows ((H, W) ids, 0 for none), and how much of each fruit is seen, by id."""
    capture = scene.captures[number]
    eye, bodies = scene.eye(capture.sensor), scene.in_sight(capture)
    who = eye.who(bodies)
    ids = np.array([*(placed.body.fruit_id for placed in bodies), 0])
    seen = {
        placed.body.fruit_id: _part_seen(who == place, eye.who([placed]) == 0) for place, placed in enumerate(bodies)
    }
    return ids[who], seen


def _part_seen(visible: np.ndarray, alone: np.ndarray) -> float:
    """Return the visible part of a fruit; 0 where it reaches into the margins that registered depth leaves empty."""
    height, width = alone.shape
    inner = np.zeros_like(alone)
    inner[height // 16 : -height // 16, width // 12 : -width // 12] = True
    if not alone.any() or (alone & ~inner).any():
        return 0.0
    return float(np.count_nonzero(visible) / np.count_nonzero(alone))


def score_views(views: tuple[FruitView, ...], owner: Ints, seen: dict[int, float]) -> SplitScore:
    """Return how well views of one frame tell its fruit apart; a view belongs to the fruit that most of it shows."""
    hits: dict[int, int] = {}
    for view in views:
        mask = np.zeros(owner.shape, np.uint8)
        cv2.drawContours(mask, [np.rint(view.outline_px).astype(np.int32)], 0, 1, cv2.FILLED)
        shown = np.bincount(owner[mask > 0])
        shown[:1] = 0
        mine = int(shown.argmax()) if shown.any() else 0
        hits[mine] = hits.get(mine, 0) + 1
    due = [fruit for fruit, part in seen.items() if part >= MOSTLY_SEEN]
    counts = [hits.get(fruit, 0) for fruit in due]
    return SplitScore(len(due), counts.count(1), counts.count(0), sum(n > 1 for n in counts), hits.get(0, 0))
