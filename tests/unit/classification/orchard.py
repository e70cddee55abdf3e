"""Made-up fruit: kinds are normal densities of known spread, so that what can be reached is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.classification.evidence import Evidence, FeatureNames, LabelledFruit
from fruitgui.frame import F64

NAMES = FeatureNames(
    (
        *(f"chroma_{letter}" for letter in "abcdefghij"),
        *(f"texture_{letter}" for letter in "abcd"),
        *(f"shape_{letter}" for letter in "abcdefghijklmnop"),
    ),
    ("volume_m3", "length_m", "diameter_m", "perimeter_m"),
)
_WIDTH, _FUSED = len(NAMES.view), len(NAMES.fruit)


@dataclass(frozen=True)
class Orchard:
    """Kinds whose means lie `apart` standard deviations from each other in the view features."""

    means: F64
    mixing: F64
    fused: F64

    @classmethod
    def planted(cls, kinds: int, apart: float, seed: int) -> Orchard:
        random = np.random.default_rng(seed)
        means = random.standard_normal((kinds, _WIDTH))
        means *= apart / np.sqrt(2.0 * _WIDTH)
        mixing = random.standard_normal((_WIDTH, _WIDTH)) / np.sqrt(_WIDTH)
        return cls(means, mixing, 0.3 * random.standard_normal((kinds, 1)))

    def fruit(self, kind: int, views: int, random: np.random.Generator) -> Evidence:
        own = self.means[kind] + self.mixing @ random.standard_normal(_WIDTH)
        seen = own + 0.5 * random.standard_normal((views, _WIDTH))
        size = self.fused[kind, 0] + 0.08 * random.standard_normal()
        fused = np.exp(size * np.array([3.0, 1.0, 1.0, 1.0]) + 0.03 * random.standard_normal(_FUSED))
        return Evidence(seen.astype(np.float32), fused * np.array([2e-4, 0.08, 0.07, 0.22]))

    def harvest(self, each: int, views: int, seed: int) -> list[LabelledFruit]:
        random = np.random.default_rng(seed)
        return [
            LabelledFruit(f"{kind}-{number}", f"kind {kind}", self.fruit(kind, views, random))
            for kind in range(len(self.means))
            for number in range(each)
        ]
