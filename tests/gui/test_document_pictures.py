"""The pictures of the README and the manual can be taken anew, all of them and no others."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication

from fruitgui.gui.shots.documents import PRINTS, SIZE, in_few_colours, picture, scene
from fruitgui.gui.shots.stage import Stage
from fruitgui.resources import folder


def test_every_picture_of_the_documents_has_its_scene_and_its_size() -> None:
    pictures = folder("docs") / "pictures"
    if not (pictures / "live.png").exists():  # those of the README do not travel with the program
        pictures = Path(__file__).parents[2] / "resources" / "docs" / "pictures"
    there = {path.relative_to(pictures).as_posix() for path in pictures.rglob("*.png")}
    assert {one.file for one in PRINTS} == there
    for one in PRINTS:
        assert scene(one.scene).name == one.scene
        if one.width_px is not None:
            assert QImage(str(pictures / one.file)).width() == one.width_px


def test_few_colours_show_a_picture_nearly_as_it_was() -> None:
    shown = QImage(str(Path(__file__).parents[2] / "resources" / "docs" / "pictures" / "live.png"))
    few = in_few_colours(shown)
    assert few.colorCount() <= 256
    assert few.size() == shown.size()
    apart = [
        abs(one - other)
        for x in range(0, shown.width(), 31)
        for y in range(0, shown.height(), 17)
        for one, other in zip(shown.pixelColor(x, y).getRgb(), few.pixelColor(x, y).getRgb(), strict=True)
    ]
    assert sum(apart) / len(apart) < 2.0


def test_one_is_taken(qapp: QApplication, tmp_path: Path) -> None:
    belt = next(one for one in PRINTS if one.file == "manual/damaged-en.png")
    taken = picture(Stage(qapp, tmp_path), belt, scene(belt.scene))
    assert 300 < taken.width() < SIZE[0]
    assert taken.height() > 200
