"""`python -m fruitgui.gui.shots.documents FOLDER`: takes the pictures of the README and of the manual anew.

`FOLDER` is `resources/docs/pictures` of a checkout; what is there is replaced.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QImage, qRgb
from PySide6.QtWidgets import QWidget

from fruitgui.gui.shots.scenes import SCENES
from fruitgui.gui.shots.stage import SIZES, Scene, Stage, drawn
from fruitgui.gui.steps.belt.region_canvas import RegionCanvas
from fruitgui.gui.steps.calibrate.sketch_view import SketchView
from fruitgui.gui.steps.teach.page import TeachPage
from fruitgui.gui.theme.theme import load_fonts

SIZE = SIZES["1280x720"]

MANUAL = "manual/"
"""Pictures of the manual travel with the program, and have few colours."""

COLOURS, EVERY = 256, 7
"""How many, and which pixels they are chosen by."""


@dataclass(frozen=True, slots=True)
class Print:
    """One picture in a document.

    Attributes:
        file: in the folder of pictures.
        scene: its name.
        theme, language: that it is taken in.
        width_px: to which it is made smaller; None for as it is.
        part: the widget of the window that is shown; the whole window where it is no more than a widget.
        share: of its height, from its top, that is shown.
    """

    file: str
    scene: str
    theme: str
    language: str
    width_px: int | None
    part: type[QWidget] = QWidget
    share: float = 1.0


PRINTS: tuple[Print, ...] = (
    Print("live.png", "live-running", "dark", "en", 960),
    Print("calibrate.png", "calibrate-good", "dark", "en", 960),
    Print("lots.png", "lots-many", "dark", "en", 960),
    Print("manual/calibrate.png", "calibrate-prepare", "light", "en", 451, SketchView),
    Print("manual/belt.png", "belt-above", "dark", "en", 560, RegionCanvas),
    *(
        one
        for language in ("en", "es")
        for one in (
            Print(f"manual/live-{language}.png", "live-running", "light", language, 1000),
            Print(f"manual/teach-{language}.png", "teach-naming", "light", language, 800, TeachPage, 0.55),
            Print(f"manual/damaged-{language}.png", "trouble-backup", "dark", language, None),
        )
    ),
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Take the pictures that are asked for, all unless told otherwise; print their names."""
    options = _parser().parse_args(arguments)
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from fruitgui.gui.app import make_qt

    qt = make_qt()
    load_fonts()
    with tempfile.TemporaryDirectory(prefix="fruitgui-prints-") as folder:
        stage = Stage(qt, Path(folder))
        for one in PRINTS:
            if not options.only or one.file in options.only:
                path = options.out / one.file
                path.parent.mkdir(parents=True, exist_ok=True)
                picture(stage, one, scene(one.scene)).save(str(path))
                sys.stdout.write(f"{path}\n")
                sys.stdout.flush()
    return 0


def scene(name: str) -> Scene:
    """Return a scene by its name."""
    return next(one for one in SCENES if one.name == name)


def picture(stage: Stage, one: Print, shown: Scene) -> QImage:
    """Take one picture."""
    stage.dress(one.theme, one.language)
    with shown.opened(stage) as window:
        if one.width_px is not None:
            window.resize(*SIZE)
        stage.settle()
        stage.wait_until(partial(drawn, window))
        part = window if one.part is QWidget else window.findChild(one.part)
        assert isinstance(part, QWidget)  # noqa: S101 - the scene shows it
        area = QRect(0, 0, part.width(), round(one.share * part.height()))
        taken = part.grab(area).toImage()
    if one.width_px is None:
        return taken
    small = taken.scaledToWidth(one.width_px, Qt.TransformationMode.SmoothTransformation)
    return in_few_colours(small) if one.file.startswith(MANUAL) else small


def in_few_colours(image: QImage) -> QImage:
    """Return a picture in the 256 colours that show it best: a fifth of the bytes."""
    from scipy.cluster.vq import kmeans2
    from scipy.spatial import KDTree

    full = image.convertToFormat(QImage.Format.Format_RGB888)
    height, width = full.height(), full.width()
    rows = np.frombuffer(full.constBits(), np.uint8).reshape(height, full.bytesPerLine())
    pixels = rows[:, : 3 * width].reshape(-1, 3)
    colours = np.unique(pixels, axis=0).astype(np.float64)
    if len(colours) > COLOURS:
        colours, _ = kmeans2(pixels[::EVERY].astype(np.float64), COLOURS, minit="++", seed=1, missing="warn")
    _, nearest = KDTree(colours).query(pixels)
    indices = np.ascontiguousarray(nearest.astype(np.uint8).reshape(height, width))
    few = QImage(indices.data, width, height, width, QImage.Format.Format_Indexed8)
    few.setColorTable([qRgb(*(round(part) for part in colour)) for colour in colours])
    return few.copy()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m fruitgui.gui.shots.documents", description=__doc__)
    parser.add_argument("out", type=Path, help="folder of the pictures")
    parser.add_argument("--only", nargs="*", default=(), metavar="FILE", help="these files only, as manual/belt.png")
    return parser


if __name__ == "__main__":
    sys.exit(main())
