"""What a person knows of kinds, kept beside the station: the mark of each, and a density that was typed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from pydantic import Field

from fruitgui.measurement.correction import Density
from fruitgui.station.model import Model
from fruitgui.station.written import Written, read_written

NAME = "kinds.json"

LIGHTEST_G_ML, HEAVIEST_G_ML = 0.2, 2.0
"""No fruit is lighter or heavier than that; what was typed beyond was a slip."""

KG_M3_PER_G_ML = 1000.0

TYPED_SPREAD = 0.03
"""Fruit of one kind differ in density by some per cent, by ripeness and stone; one typed number does not tell that."""

DensityGMl = Annotated[float, Field(ge=LIGHTEST_G_ML, le=HEAVIEST_G_ML)]


class KindNote(Written):
    """What is kept of one kind.

    Attributes:
        mark: number of its colour and shape; None before it was shown.
        letters: in its mark.
        density_g_ml: as a person typed it; None leaves it to the reference fruit.
    """

    mark: Annotated[int, Field(ge=0, le=10_000)] | None = None
    letters: Annotated[str, Field(max_length=4)] = ""
    density_g_ml: DensityGMl | None = None


class KindNotes(Written):
    """What is kept of all kinds, by name; a kind that is not taught any more keeps its note."""

    kinds: dict[str, KindNote] = Field(default_factory=dict)

    def of(self, kind: str) -> KindNote:
        """Return the note of a kind, an empty one where nothing is known."""
        return self.kinds.get(kind, KindNote())

    def typed_densities(self) -> Mapping[str, float]:
        """Return the densities that were typed, g/ml, by kind."""
        return {kind: one.density_g_ml for kind, one in self.kinds.items() if one.density_g_ml is not None}

    def with_density(self, kind: str, density_g_ml: float | None) -> KindNotes:
        """Return the notes with another typed density of a kind, None for none."""
        note = self.of(kind).model_copy(update={"density_g_ml": density_g_ml})
        return self.model_copy(update={"kinds": {**self.kinds, kind: note}})


def read_kind_notes(folder: Path) -> KindNotes:
    """Return the notes of the line whose files lie in a folder; none where there is no such file.

    Raises:
        InputError: the file cannot be used.
    """
    path = folder / NAME
    return read_written(path, KindNotes) if path.exists() else KindNotes()


def with_typed_densities(model: Model, notes: KindNotes) -> Model:
    """Return a model in which a density that a person typed stands for the one that reference fruit taught."""
    typed = {
        kind: Density(KG_M3_PER_G_ML * density_g_ml, TYPED_SPREAD * KG_M3_PER_G_ML * density_g_ml)
        for kind, density_g_ml in notes.typed_densities().items()
    }
    if not typed:
        return model
    return replace(model, correction=replace(model.correction, densities={**model.correction.densities, **typed}))
