"""What a person knows of kinds is kept, and a typed density stands for a learned one."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import pytest

from fruitgui.errors import InputError
from fruitgui.measurement.correction import Density, VolumeCorrection
from fruitgui.measurement.fruit import Quantity
from fruitgui.station.kinds_file import NAME, KindNotes, read_kind_notes, with_typed_densities
from fruitgui.station.model import Model
from fruitgui.station.workspace import open_workspace


def model() -> Model:
    learned = {"lemon": Density(960.0, 12.0), "pear": Density(1010.0, 15.0)}
    return Model(cast("Any", None), VolumeCorrection(densities=learned))


def test_a_typed_density_stands_for_a_learned_one_and_the_others_stay() -> None:
    notes = KindNotes().with_density("lemon", 0.9).with_density("kiwi", 1.05)
    typed = with_typed_densities(model(), notes)
    assert {kind: one.value for kind, one in typed.correction.densities.items()} == {
        "lemon": 900.0, "pear": 1010.0, "kiwi": 1050.0,
    }  # fmt: skip
    mass = typed.correction.mass("lemon", Quantity(100e-6, 1e-6))
    assert mass is not None
    assert mass.value == pytest.approx(0.090)
    assert mass.std > 0.02 * mass.value, "one typed number does not tell how fruit differ"


def test_taking_a_typed_density_away_brings_the_learned_one_back() -> None:
    notes = KindNotes().with_density("lemon", 0.9).with_density("lemon", None)
    assert with_typed_densities(model(), notes).correction.densities["lemon"] == Density(960.0, 12.0)


def test_notes_are_kept_beside_the_station(tmp_path: Path) -> None:
    assert read_kind_notes(tmp_path) == KindNotes()
    workspace = open_workspace(tmp_path)
    workspace.kinds.save(KindNotes().with_density("lemon", 0.9))
    assert workspace.kinds.path == tmp_path / NAME
    assert read_kind_notes(tmp_path).typed_densities() == {"lemon": 0.9}


@pytest.mark.parametrize("density", ["0", "-1", "97", "null_", '"heavy"', "1e400"])
def test_a_density_that_no_fruit_has_is_refused(tmp_path: Path, density: str) -> None:
    (tmp_path / NAME).write_text(f'{{"kinds": {{"lemon": {{"density_g_ml": {density}}}}}}}')
    with pytest.raises(InputError):
        read_kind_notes(tmp_path)
