"""A workspace of a line whose fruit came in: what tests of teaching and training copy."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest

from fruitgui.gui.shots.school import school
from fruitgui.simulation.scenes import line_scene
from tests.made_once import made_once

FRUIT = 12
KINDS = ("lemon", "red_apple")


def nameless_school(factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a school whose fruit have no kind yet; only to be copied."""
    line = partial(line_scene, 7, fruit=FRUIT, speed_m_s=0.3, layout="single", kinds=KINDS, restless=0.0)
    folder = made_once(factory, "school", lambda folder: school(folder / "line", line(), named=False))
    return folder / "line"
