"""A workspace of a line whose fruit came in: what tests of teaching and training copy."""

from __future__ import annotations

from pathlib import Path

import pytest

from fruitgui.gui.shots.school import school, small_class
from tests.made_once import made_once

FRUIT = 12


def nameless_school(factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a school whose fruit have no kind yet; only to be copied."""
    folder = made_once(factory, "school", lambda folder: school(folder / "line", small_class(FRUIT), named=False))
    return folder / "line"
