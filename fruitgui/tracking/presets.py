"""The source's own noise values, kept as a named preset beside the code."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from fruitgui.resources import folder


@dataclass(frozen=True, slots=True)
class PaperPreset:
    """Diagonals of the source's covariances (section 2.8), as printed.

    Attributes:
        rotation: nine variances of the entries of Δ_R, by rows.
        translation_m2: three variances of Δ_T.
        process_m2: variance per axis and 0.1 s of Σ_η.
    """

    rotation: tuple[float, ...]
    translation_m2: tuple[float, ...]
    process_m2: float


def paper_preset() -> PaperPreset:
    """Return the preset `paper`, from the installed package or from a checkout."""
    values = _read("paper.json")
    return PaperPreset(
        tuple(float(value) for value in values["rotation_variance"]),
        tuple(float(value) for value in values["translation_variance_m2"]),
        float(values["process_variance_m2_per_100_ms"]),
    )


def _read(name: str) -> dict[str, Any]:
    values: dict[str, Any] = json.loads((folder("presets") / name).read_text(encoding="utf-8"))
    return values
