"""The cloud in three dimensions, on a screen of its own that has OpenGL; left out where there is no such screen."""

from __future__ import annotations

from pathlib import Path

from tests.gui.xvfb import run_on_screen

SCRIPT = """
import sys
import numpy as np
from PySide6.QtWidgets import QApplication
from fruitgui.gui.steps.calibrate.cloud_view import CloudView
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.fused_cloud import SensorCloud

app = QApplication([])
view = CloudView(Theme())
if view.solid is None:
    sys.exit(77)
view.resize(640, 480)
view.show()
rng = np.random.default_rng(1)
flat = np.hstack([rng.uniform(-0.4, 0.4, (4000, 2)), np.full((4000, 1), 0.02)]).astype(np.float32)
clouds = [SensorCloud(name, flat, flat, np.zeros((4000, 3), np.uint8)) for name in ("a", "b")]
view.show_clouds(clouds, compared=True)

def lit():
    while not view.drawn:
        app.processEvents()
    app.processEvents()
    image = view.solid.view.grabFramebuffer()
    places = [(u, v) for u in range(0, image.width(), 3) for v in range(0, image.height(), 3)]
    colours = [image.pixelColor(*place) for place in places]
    return sum(one.red() > one.blue() + 40 for one in colours), sum(one.blue() > one.red() + 40 for one in colours)

orange, blue = lit()
assert orange + blue > 200, (orange, blue)
view.fade.setValue(0)
orange, blue = lit()
assert orange > 100 and blue == 0, (orange, blue)
view.fade.setValue(view.fade.maximum())
orange, blue = lit()
assert orange == 0 and blue > 100, (orange, blue)
view.close()
"""


def test_points_are_seen_and_the_slider_fades_between_sensors(tmp_path: Path) -> None:
    run_on_screen(SCRIPT, tmp_path)
