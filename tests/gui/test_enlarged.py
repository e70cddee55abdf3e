"""The window's words in another size: what is offered, what is put on, and what a small screen has."""

from __future__ import annotations

import subprocess
import sys

import pytest
from PySide6.QtCore import QSize

from fruitgui.gui.enlarged import offered

PROGRAM = """
import sys
from PySide6.QtWidgets import QApplication
from fruitgui.gui import enlarged
enlarged.LEAST = enlarged.QSize(int(sys.argv[2]), 100)
qt = enlarged.enlarged(lambda: QApplication(sys.argv[:1]), int(sys.argv[1]))
print(qt.primaryScreen().devicePixelRatio(), enlarged.offered(qt.primaryScreen().availableSize(), 100))
"""


@pytest.mark.parametrize(
    ("screen", "chosen", "sizes"),
    [
        ((1280, 720), 100, (100,)),
        ((1920, 1040), 100, (100, 125)),
        ((2560, 1440), 100, (100, 125, 150, 200)),
        ((1280, 720), 200, (100, 200)),
    ],
)
def test_only_sizes_at_which_the_least_window_is_on_the_screen_are_offered(
    screen: tuple[int, int], chosen: int, sizes: tuple[int, ...]
) -> None:
    assert offered(QSize(*screen), chosen) == sizes


@pytest.mark.parametrize(
    ("percent", "least", "said"),
    [(100, 400, "1.0 (100, 125, 150, 200)"), (150, 400, "1.5 (100, 125, 150, 200)"), (200, 500, "1.0 (100, 125, 150)")],
)
def test_the_size_is_put_on_where_the_screen_has_room_for_it(percent: int, least: int, said: str) -> None:
    """Qt's own screen without a display has 800 pixels in a row; the size is for a whole process."""
    command = [sys.executable, "-c", PROGRAM, str(percent), str(least)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert done.stdout.strip() == said, done.stderr
